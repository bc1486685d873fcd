// SPDX-License-Identifier: Apache-2.0
// Adds timers to callback groups, where executors find them.
#pragma once

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp::node_interfaces {

class NodeTimersInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeTimersInterface)
  virtual ~NodeTimersInterface() = default;

  // Null means the default group. Throws std::runtime_error if the group belongs to another node.
  virtual void add_timer(TimerBase::SharedPtr timer, CallbackGroup::SharedPtr group) = 0;
};

}  // namespace rclcpp::node_interfaces
