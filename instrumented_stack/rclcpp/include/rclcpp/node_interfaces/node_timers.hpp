// SPDX-License-Identifier: Apache-2.0
// Adds timers to callback groups, where executors find them.
#pragma once

#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp::node_interfaces {

class NodeTimers {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeTimers)

  explicit NodeTimers(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  // Null means the default group. Throws std::runtime_error if the group belongs to another node.
  void add_timer(const TimerBase::SharedPtr& timer, const CallbackGroup::SharedPtr& group);

  const NodeBaseInterface::SharedPtr& get_node_base_interface() const { return node_base_; }

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

using NodeTimersInterface = NodeTimers;

}  // namespace rclcpp::node_interfaces
