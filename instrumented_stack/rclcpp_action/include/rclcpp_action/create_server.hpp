// SPDX-License-Identifier: Apache-2.0
// Creates servers of actions for nodes.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_clock_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"
#include "rclcpp_action/detail/add_to_node.hpp"
#include "rclcpp_action/server.hpp"

namespace rclcpp_action {

// `node` points to a node. A null group means the default callback group. Throws rclcpp::exceptions::RCLError.
template <typename ActionT, typename NodeT>
typename Server<ActionT>::SharedPtr create_server(
    NodeT node, const std::string& name, typename Server<ActionT>::GoalCallback handle_goal,
    typename Server<ActionT>::CancelCallback handle_cancel, typename Server<ActionT>::AcceptedCallback handle_accepted,
    const rcl_action_server_options_t& options = rcl_action_server_get_default_options(),
    rclcpp::CallbackGroup::SharedPtr group = nullptr) {
  return detail::add_to_node(std::make_shared<Server<ActionT>>(
                                 node->get_node_base_interface(), node->get_clock(), node->get_logger(), name, options,
                                 std::move(handle_goal), std::move(handle_cancel), std::move(handle_accepted)),
                             node->get_node_waitables_interface(), group);
}

// The same for code that has interfaces instead of a node.
template <typename ActionT>
typename Server<ActionT>::SharedPtr create_server(
    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base,
    rclcpp::node_interfaces::NodeClockInterface::SharedPtr node_clock,
    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging,
    rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr node_waitables, const std::string& name,
    typename Server<ActionT>::GoalCallback handle_goal, typename Server<ActionT>::CancelCallback handle_cancel,
    typename Server<ActionT>::AcceptedCallback handle_accepted,
    const rcl_action_server_options_t& options = rcl_action_server_get_default_options(),
    rclcpp::CallbackGroup::SharedPtr group = nullptr) {
  return detail::add_to_node(std::make_shared<Server<ActionT>>(
                                 std::move(node_base), node_clock->get_clock(), node_logging->get_logger(), name,
                                 options, std::move(handle_goal), std::move(handle_cancel), std::move(handle_accepted)),
                             node_waitables, group);
}

}  // namespace rclcpp_action
