// SPDX-License-Identifier: Apache-2.0
// The clock of a node, for code that gets interfaces instead of a node.
#pragma once

#include <utility>

#include "rclcpp/clock.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::node_interfaces {

class NodeClock {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeClock)

  explicit NodeClock(Clock::SharedPtr clock) : clock_(std::move(clock)) {}

  Clock::SharedPtr get_clock() { return clock_; }
  Clock::ConstSharedPtr get_clock() const { return clock_; }

 private:
  Clock::SharedPtr clock_;
};

using NodeClockInterface = NodeClock;

}  // namespace rclcpp::node_interfaces
