// SPDX-License-Identifier: Apache-2.0
// Creates clients of actions whose type is known only by name.
#pragma once

#include <string>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"
#include "rclcpp_action/generic_client.hpp"

namespace rclcpp_action {

// `type` looks like "example_interfaces/action/Fibonacci". A null group means the default callback group. Throws
// std::runtime_error if the type cannot be found, and rclcpp::exceptions::RCLError.
GenericClient::SharedPtr create_generic_client(
    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base_interface,
    rclcpp::node_interfaces::NodeGraphInterface::SharedPtr node_graph_interface,
    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging_interface,
    rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr node_waitables_interface, const std::string& name,
    const std::string& type, rclcpp::CallbackGroup::SharedPtr group = nullptr,
    const rcl_action_client_options_t& options = rcl_action_client_get_default_options());

// `node` points to a node.
template <typename NodeT>
GenericClient::SharedPtr create_generic_client(
    NodeT node, const std::string& name, const std::string& type, rclcpp::CallbackGroup::SharedPtr group = nullptr,
    const rcl_action_client_options_t& options = rcl_action_client_get_default_options()) {
  return create_generic_client(node->get_node_base_interface(), node->get_node_graph_interface(),
                               node->get_node_logging_interface(), node->get_node_waitables_interface(), name, type,
                               group, options);
}

}  // namespace rclcpp_action
