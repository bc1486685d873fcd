// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "arm_driver/arm_model.hpp"

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto arm = arm_driver::make_arm(rclcpp::NodeOptions());
  std::printf("%s\n%s\n", arm->get_fully_qualified_name(), to_yaml(arm_driver::hold(3.0), true).c_str());
  rclcpp::shutdown();
}
