// Drives a node's clock from the topic /clock while the parameter use_sim_time is true.
//
// The messages come through the node's default callback group: simulated time advances while the node is spun.
#pragma once

#include <rosgraph_msgs/msg/clock.hpp>

#include "rclcpp/node.hpp"

namespace rclcpp::node_interfaces {

class TimeSource {
 public:
  // Declares use_sim_time unless it is declared. Throws exceptions::InvalidParameterTypeException if it is no bool.
  explicit TimeSource(Node& node);

 private:
  void use_sim_time(bool enabled);
  void set_time(const rosgraph_msgs::msg::Clock& message);

  Node& node_;
  Clock::SharedPtr clock_;
  Subscription<rosgraph_msgs::msg::Clock>::SharedPtr subscription_;
  PostSetParametersCallbackHandle::SharedPtr parameter_callback_;
};

}  // namespace rclcpp::node_interfaces
