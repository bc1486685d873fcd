// SPDX-License-Identifier: Apache-2.0
// node_interfaces::get_node_logging_interface(node), for any class that has that interface, or a pointer to one; or for
// the interface.
#pragma once

#include <memory>

#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"

namespace rclcpp::node_interfaces {

template <typename NodeT>
std::shared_ptr<NodeLoggingInterface> get_node_logging_interface(NodeT&& node) {
  if constexpr (IsSharedInterface<NodeT, NodeLoggingInterface>::value) {
    return node;
  } else {
    return dereferenced(node).get_node_logging_interface();
  }
}

}  // namespace rclcpp::node_interfaces
