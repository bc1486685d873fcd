// SPDX-License-Identifier: Apache-2.0
// What the free functions of rclcpp accept as a node: a Node, a LifecycleNode, or a plain, shared or unique pointer to
// one.
#pragma once

#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace rclcpp::node_interfaces {

template <typename NodeT, typename EnableT = void>
struct IsPointerLike : std::false_type {};
template <typename NodeT>
struct IsPointerLike<NodeT, std::void_t<decltype(*std::declval<NodeT&>())>> : std::true_type {};

// Whether a function that looks for this interface is passed the interface itself.
template <typename NodeT, typename InterfaceT>
using IsSharedInterface = std::is_same<std::remove_cv_t<std::remove_reference_t<NodeT>>, std::shared_ptr<InterfaceT>>;

// Throws std::invalid_argument for a null pointer.
template <typename NodeT>
auto& dereferenced(NodeT& node) {
  if constexpr (IsPointerLike<NodeT>::value) {
    if constexpr (std::is_constructible_v<bool, NodeT&>) {
      if (!static_cast<bool>(node)) {
        throw std::invalid_argument("node cannot be nullptr");
      }
    }
    return *node;
  } else {
    return node;
  }
}

}  // namespace rclcpp::node_interfaces
