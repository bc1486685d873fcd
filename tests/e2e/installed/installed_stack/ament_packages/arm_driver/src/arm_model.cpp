// SPDX-License-Identifier: Apache-2.0
#include "arm_driver/arm_model.hpp"

#include "arm_driver/version.h"

#if !ARM_DRIVER_VERSION_GTE(1, 4, 2) || ARM_DRIVER_VERSION_GTE(1, 4, 3)
#error the version is not that of package.xml
#endif

namespace arm_driver {

msg::Effort hold(double load) {
  msg::Effort effort;
  effort.header.frame_id = "shoulder";
  effort.torques = {load, load / 2};
  return effort;
}

rclcpp::Node::SharedPtr make_arm(const rclcpp::NodeOptions& options) {
  return std::make_shared<rclcpp::Node>("arm", options);
}

}  // namespace arm_driver
