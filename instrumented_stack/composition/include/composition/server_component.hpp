// SPDX-License-Identifier: Apache-2.0
// Adds two numbers for clients of service add_two_ints.
#pragma once

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"

namespace composition {

class Server : public rclcpp::Node {
 public:
  explicit Server(const rclcpp::NodeOptions& options);

 private:
  rclcpp::Service<example_interfaces::srv::AddTwoInts>::SharedPtr service_;
};

}  // namespace composition
