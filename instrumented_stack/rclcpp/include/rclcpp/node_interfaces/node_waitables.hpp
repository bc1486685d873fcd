// SPDX-License-Identifier: Apache-2.0
// Adds waitables to the callback groups of a node.
#pragma once

#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"

namespace rclcpp::node_interfaces {

class NodeWaitables : public NodeWaitablesInterface {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(NodeWaitables)

  explicit NodeWaitables(NodeBaseInterface::SharedPtr node_base) : node_base_(std::move(node_base)) {}

  void add_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) override;
  void remove_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) noexcept override;

 private:
  NodeBaseInterface::SharedPtr node_base_;
};

}  // namespace rclcpp::node_interfaces
