// SPDX-License-Identifier: Apache-2.0
// node_interfaces::get_node_parameters_interface(node), for any class that has that interface, or a pointer to one; or
// for the interface.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"

namespace rclcpp::node_interfaces {

template <typename NodeT>
std::shared_ptr<NodeParametersInterface> get_node_parameters_interface(NodeT&& node) {
  if constexpr (IsSharedInterface<NodeT, NodeParametersInterface>::value) {
    return node;
  } else {
    return dereferenced(node).get_node_parameters_interface();
  }
}

template <typename NodeT, typename EnableT = void>
struct HasNodeParameters : std::false_type {};
template <typename NodeT>
struct HasNodeParameters<NodeT, std::void_t<decltype(std::declval<NodeT>().get_node_parameters_interface())>>
    : std::true_type {};

// Null if there is none.
template <typename NodeT>
std::shared_ptr<NodeParametersInterface> find_node_parameters_interface(NodeT& node) {
  if constexpr (HasNodeParameters<decltype(dereferenced(node))>::value) {
    return dereferenced(node).get_node_parameters_interface();
  } else {
    return nullptr;
  }
}

}  // namespace rclcpp::node_interfaces
