// SPDX-License-Identifier: Apache-2.0
// Adds waitables to callback groups, where executors find them.
#pragma once

#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp::node_interfaces {

class NodeWaitables {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeWaitables)

  explicit NodeWaitables(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  // Null means the default group. The group holds the waitable weakly. Throws std::runtime_error if the group belongs
  // to another node.
  void add_waitable(const Waitable::SharedPtr& waitable, const CallbackGroup::SharedPtr& group);
  // Does nothing if the group (null: the default one) belongs to another node or does not have the waitable.
  void remove_waitable(const Waitable::SharedPtr& waitable, const CallbackGroup::SharedPtr& group) noexcept;

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

using NodeWaitablesInterface = NodeWaitables;

}  // namespace rclcpp::node_interfaces
