// SPDX-License-Identifier: Apache-2.0
// What the free functions of rclcpp accept as a node: a Node, a LifecycleNode, or a plain, shared or unique pointer to
// one.
#pragma once

#include <type_traits>
#include <utility>

namespace rclcpp::node_interfaces {

template <typename NodeT, typename EnableT = void>
struct IsPointerLike : std::false_type {};
template <typename NodeT>
struct IsPointerLike<NodeT, std::void_t<decltype(*std::declval<NodeT&>())>> : std::true_type {};

template <typename NodeT>
auto& dereferenced(NodeT& node) {
  if constexpr (IsPointerLike<NodeT>::value) {
    return *node;
  } else {
    return node;
  }
}

}  // namespace rclcpp::node_interfaces
