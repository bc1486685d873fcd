// SPDX-License-Identifier: Apache-2.0
// Asks service add_two_ints for a sum every two seconds.
#pragma once

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"

namespace composition {

class Client : public rclcpp::Node {
 public:
  explicit Client(const rclcpp::NodeOptions& options);

 private:
  void ask();

  rclcpp::Client<example_interfaces::srv::AddTwoInts>::SharedPtr client_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace composition
