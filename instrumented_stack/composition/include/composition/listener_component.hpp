// SPDX-License-Identifier: Apache-2.0
// Prints the messages of topic chatter.
#pragma once

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

namespace composition {

class Listener : public rclcpp::Node {
 public:
  explicit Listener(const rclcpp::NodeOptions& options);

 private:
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

}  // namespace composition
