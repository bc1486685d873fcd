// SPDX-License-Identifier: Apache-2.0
// A listener that has a node but is none: a component needs only get_node_base_interface().
#pragma once

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

namespace composition {

class NodeLikeListener {
 public:
  explicit NodeLikeListener(const rclcpp::NodeOptions& options);

  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() const;

 private:
  rclcpp::Node::SharedPtr node_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr subscription_;
};

}  // namespace composition
