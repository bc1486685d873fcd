// SPDX-License-Identifier: Apache-2.0
// Adds timers to the callback groups of a node.
#pragma once

#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeTimers : public NodeTimersInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeTimers)

  explicit NodeTimers(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  void add_timer(TimerBase::SharedPtr timer, CallbackGroup::SharedPtr group) override;

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

}  // namespace rclcpp::node_interfaces
