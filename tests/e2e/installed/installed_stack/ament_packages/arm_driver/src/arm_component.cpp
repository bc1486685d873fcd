// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <rclcpp_components/register_node_macro.hpp>

#include "arm_driver/arm_model.hpp"

namespace arm_driver {

class ArmComponent : public rclcpp::Node {
 public:
  explicit ArmComponent(const rclcpp::NodeOptions& options) : Node("arm_component", options) {}
};

// It does all of its work when it is created.
class SelfTest : public rclcpp::Node {
 public:
  explicit SelfTest(const rclcpp::NodeOptions& options) : Node("self_test", options) {
    std::puts("the arm is there");
    rclcpp::shutdown();
  }
};

}  // namespace arm_driver

RCLCPP_COMPONENTS_REGISTER_NODE(arm_driver::ArmComponent)
RCLCPP_COMPONENTS_REGISTER_NODE(arm_driver::SelfTest)
