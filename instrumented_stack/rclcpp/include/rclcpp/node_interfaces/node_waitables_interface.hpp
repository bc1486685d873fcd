// SPDX-License-Identifier: Apache-2.0
// Adds waitables to callback groups, where executors find them.
#pragma once

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp::node_interfaces {

class NodeWaitablesInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeWaitablesInterface)
  virtual ~NodeWaitablesInterface() = default;

  // Null means the default group. The group holds the waitable weakly. Throws std::runtime_error if the group belongs
  // to another node.
  virtual void add_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) = 0;
  // Does nothing if the group (null: the default one) belongs to another node or does not have the waitable.
  virtual void remove_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) noexcept = 0;
};

}  // namespace rclcpp::node_interfaces
