// Clients of actions for nodes.
#pragma once

#include <memory>
#include <string>

#include "rclcpp_action/client.hpp"
#include "rclcpp_action/detail/add_to_node.hpp"

namespace rclcpp_action {

// `node` points to a node. Null group: the default callback group. Throws rclcpp::exceptions::RCLError.
template <typename ActionT, typename NodeT>
typename Client<ActionT>::SharedPtr create_client(
    NodeT node, const std::string& name, rclcpp::CallbackGroup::SharedPtr group = nullptr,
    const rcl_action_client_options_t& options = rcl_action_client_get_default_options()) {
  return detail::add_to_node(
      std::make_shared<Client<ActionT>>(node->get_node_base_interface(), node->get_logger(), name, options),
      node->get_node_waitables_interface(), group);
}

}  // namespace rclcpp_action
