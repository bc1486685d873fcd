// SPDX-License-Identifier: Apache-2.0
// An empty node: tells when it has spun for the first time, and spins until it is ended.
#include <memory>
#include <rclcpp/rclcpp.hpp>

#include "ready_node.hpp"

int main(int argc, char** argv) {
  const std::int64_t begun = node_start::now(CLOCK_MONOTONIC);
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("node");
  rclcpp::spin_some(node);
  node_start::tell_ready(begun);
  rclcpp::spin(node);
  rclcpp::shutdown();
}
