// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "track_diagnostics/updater.hpp"

TEST(Updater, PublishesAsOftenAsItsParameterSays) {
  rclcpp::init(0, nullptr);
  const auto node = std::make_shared<rclcpp_lifecycle::LifecycleNode>(
      "motor", rclcpp::NodeOptions().parameter_overrides({{"diagnostic_updater.period", 0.01}}));
  track_diagnostics::Updater updater(node);
  updater.add("temperature", [](track_diagnostics::Status& status) {
    status.summary(track_diagnostics::Status::OK, "cold");
    status.add("degrees", 20);
  });
  diagnostic_msgs::msg::DiagnosticArray::SharedPtr last;
  const auto subscription = node->create_subscription<diagnostic_msgs::msg::DiagnosticArray>(
      "/diagnostics", 1, [&](diagnostic_msgs::msg::DiagnosticArray::SharedPtr message) { last = message; });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node->get_node_base_interface());
  while (last == nullptr) {
    executor.spin_once();
  }
  EXPECT_EQ(last->status.at(0).name, "motor: temperature");
  EXPECT_EQ(last->status.at(0).values.at(0).value, "20");
  rclcpp::shutdown();
}
