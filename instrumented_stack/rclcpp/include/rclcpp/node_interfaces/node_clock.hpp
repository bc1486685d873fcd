// SPDX-License-Identifier: Apache-2.0
// The clock of a node.
#pragma once

#include <utility>

#include "rclcpp/node_interfaces/node_clock_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeClock : public NodeClockInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeClock)

  explicit NodeClock(Clock::SharedPtr clock) : clock_(std::move(clock)) {}

  Clock::SharedPtr get_clock() override { return clock_; }
  Clock::ConstSharedPtr get_clock() const override { return clock_; }

 private:
  Clock::SharedPtr clock_;
};

}  // namespace rclcpp::node_interfaces
