// SPDX-License-Identifier: Apache-2.0
// What the measured programs on rclcpp share: the messages of each size, and the wait for the other side. Nothing but
// rclcpp and latency_msgs, so that they can be built against another rclcpp as well.
#pragma once

#include <chrono>
#include <cstddef>
#include <latency_msgs/msg/bytes1k.hpp>
#include <latency_msgs/msg/bytes256k.hpp>
#include <latency_msgs/msg/bytes32k.hpp>
#include <latency_msgs/msg/bytes64k.hpp>
#include <rclcpp/rclcpp.hpp>
#include <tuple>

#include "worker.hpp"

namespace latency {

// In the order of kSizes.
using Messages = std::tuple<latency_msgs::msg::Bytes1k, latency_msgs::msg::Bytes32k, latency_msgs::msg::Bytes64k,
                            latency_msgs::msg::Bytes256k>;
template <std::size_t I>
using Message = std::tuple_element_t<I, Messages>;

// Time between checks whether the other side is there.
inline constexpr std::chrono::milliseconds kLookAgain{20};

// Tells the measuring program when `matched` is true.
template <typename Matched>
void wait_until(const rclcpp::Node::SharedPtr& node, Matched matched) {
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  const auto timer = node->create_wall_timer(kLookAgain, [] {});
  while (!matched()) {
    executor.spin_once();
  }
  tell_ready();
}

}  // namespace latency
