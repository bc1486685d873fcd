// SPDX-License-Identifier: Apache-2.0
// node_interfaces::get_node_topics_interface(node), for any class that has that interface, or a pointer to one; or for
// the interface.
#pragma once

#include <memory>

#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"

namespace rclcpp::node_interfaces {

template <typename NodeT>
std::shared_ptr<NodeTopicsInterface> get_node_topics_interface(NodeT&& node) {
  if constexpr (IsSharedInterface<NodeT, NodeTopicsInterface>::value) {
    return node;
  } else {
    return dereferenced(node).get_node_topics_interface();
  }
}

}  // namespace rclcpp::node_interfaces
