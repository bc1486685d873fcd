// SPDX-License-Identifier: Apache-2.0
// Says hello on topic chatter once a second.
#pragma once

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

namespace composition {

class Talker : public rclcpp::Node {
 public:
  explicit Talker(const rclcpp::NodeOptions& options);

 private:
  void say_hello();

  size_t count_ = 0;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr publisher_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace composition
