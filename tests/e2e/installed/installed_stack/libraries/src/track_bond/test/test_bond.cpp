// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>

#include "track_bond/bond.hpp"

using std::chrono::milliseconds;

TEST(Bond, BreaksWhenTheOtherEndIsGone) {
  rclcpp::init(0, nullptr);
  const auto node = std::make_shared<rclcpp::Node>("a");
  const auto lifecycle_node = std::make_shared<rclcpp_lifecycle::LifecycleNode>("b");
  bool broken = false;
  track_bond::Bond one("bond", "id", node, [&] { broken = true; });
  std::optional<track_bond::Bond> other;
  other.emplace("bond", "id", lifecycle_node, nullptr);
  one.start(milliseconds(10), milliseconds(60'000));
  other->start(milliseconds(10), milliseconds(60'000));
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  executor.add_node(lifecycle_node->get_node_base_interface());
  while (!one.is_formed() || !other->is_formed()) {
    executor.spin_once();
  }
  other.reset();
  while (!broken) {
    executor.spin_once();
  }
  EXPECT_FALSE(one.is_formed());
  rclcpp::shutdown();
}
