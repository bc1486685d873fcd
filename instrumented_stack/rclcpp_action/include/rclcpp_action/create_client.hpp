// SPDX-License-Identifier: Apache-2.0
// Creates clients of actions for nodes.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"
#include "rclcpp_action/client.hpp"
#include "rclcpp_action/detail/add_to_node.hpp"

namespace rclcpp_action {

// `node` points to a node. A null group means the default callback group. Throws rclcpp::exceptions::RCLError.
template <typename ActionT, typename NodeT>
typename Client<ActionT>::SharedPtr create_client(
    NodeT node, const std::string& name, rclcpp::CallbackGroup::SharedPtr group = nullptr,
    const rcl_action_client_options_t& options = rcl_action_client_get_default_options()) {
  return detail::add_to_node(
      std::make_shared<Client<ActionT>>(node->get_node_base_interface(), node->get_logger(), name, options),
      node->get_node_waitables_interface(), group);
}

// The same for code that has interfaces instead of a node.
template <typename ActionT>
typename Client<ActionT>::SharedPtr create_client(
    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base,
    rclcpp::node_interfaces::NodeGraphInterface::SharedPtr /*node_graph*/,
    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging,
    rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr node_waitables, const std::string& name,
    rclcpp::CallbackGroup::SharedPtr group = nullptr,
    const rcl_action_client_options_t& options = rcl_action_client_get_default_options()) {
  return detail::add_to_node(
      std::make_shared<Client<ActionT>>(std::move(node_base), node_logging->get_logger(), name, options),
      node_waitables, group);
}

}  // namespace rclcpp_action
