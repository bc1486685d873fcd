// SPDX-License-Identifier: Apache-2.0
// Adds servers and clients of actions to a node's executor.
#pragma once

#include <memory>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"

namespace rclcpp_action::detail {

// The pointer for the user. Its deleter removes the waitable from the executor, which may own it while it waits.
template <typename WaitableT>
std::shared_ptr<WaitableT> add_to_node(std::shared_ptr<WaitableT> waitable,
                                       const rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr& waitables,
                                       const rclcpp::CallbackGroup::SharedPtr& group) {
  waitables->add_waitable(waitable, group);
  const std::weak_ptr<rclcpp::node_interfaces::NodeWaitablesInterface> weak_waitables = waitables;
  const std::weak_ptr<rclcpp::CallbackGroup> weak_group = group;
  const bool is_default_group = group == nullptr;
  WaitableT* const address = waitable.get();
  return std::shared_ptr<WaitableT>(
      address, [waitable = std::move(waitable), weak_waitables, weak_group, is_default_group](WaitableT*) mutable {
        const auto living_waitables = weak_waitables.lock();
        const auto living_group = weak_group.lock();
        if (living_waitables && (living_group || is_default_group)) {
          living_waitables->remove_waitable(waitable, living_group);
        }
        waitable.reset();
      });
}

}  // namespace rclcpp_action::detail
