// SPDX-License-Identifier: Apache-2.0
// node_interfaces::get_node_timers_interface(node), for any class that has that interface, or a pointer to one; or for
// the interface.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"

namespace rclcpp::node_interfaces {

template <typename NodeT>
std::shared_ptr<NodeTimersInterface> get_node_timers_interface(NodeT&& node) {
  if constexpr (IsSharedInterface<NodeT, NodeTimersInterface>::value) {
    return node;
  } else {
    return dereferenced(node).get_node_timers_interface();
  }
}

template <typename NodeT, typename EnableT = void>
struct HasNodeTimers : std::false_type {};
// Not a topics interface, whose function of this name returns a plain pointer.
template <typename NodeT>
struct HasNodeTimers<NodeT, std::void_t<decltype(std::declval<NodeT>().get_node_timers_interface())>>
    : std::is_convertible<decltype(std::declval<NodeT>().get_node_timers_interface()),
                          std::shared_ptr<NodeTimersInterface>> {};

// Null if there is none.
template <typename NodeT>
std::shared_ptr<NodeTimersInterface> find_node_timers_interface(NodeT& node) {
  if constexpr (HasNodeTimers<decltype(dereferenced(node))>::value) {
    return dereferenced(node).get_node_timers_interface();
  } else {
    return nullptr;
  }
}

}  // namespace rclcpp::node_interfaces
