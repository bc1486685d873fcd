// SPDX-License-Identifier: Apache-2.0
// A node whose logger levels can be set from outside. It logs a debug message again and again.
#include <chrono>

#include "rclcpp/rclcpp.hpp"

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node =
      std::make_shared<rclcpp::Node>("worker", "/left", rclcpp::NodeOptions().enable_logger_service(true));
  const auto timer =
      node->create_wall_timer(std::chrono::milliseconds(20), [&] { RCLCPP_DEBUG(node->get_logger(), "a detail"); });
  rclcpp::spin(node);
  rclcpp::shutdown();
}
