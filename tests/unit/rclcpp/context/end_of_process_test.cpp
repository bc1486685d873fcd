// SPDX-License-Identifier: Apache-2.0
// Nodes that are still there when their process ends.
#include <gtest/gtest.h>

#include <memory>
#include <std_msgs/msg/string.hpp>
#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using std_msgs::msg::String;
using test_support::CommandResult;
using test_support::RunningCommand;

class EndOfProcess : public RosTest, public testing::WithParamInterface<const char*> {};

TEST_P(EndOfProcess, WithANodeIsToldToOthersAndIsNoCrash) {
  if (test_support::kSanitized && std::string(GetParam()) == "fork") {
    GTEST_SKIP() << "skipped, because sanitizers miss the threads that the child of a fork does not have";
  }
  std::string heard;
  const auto listener = std::make_shared<rclcpp::Node>("listener");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(listener);
  const auto subscription = listener->create_subscription<String>(
      "ends", rclcpp::QoS(1).transient_local(), [&heard](const String& message) { heard += message.data; });
  RunningCommand process({.argv = {NODE_AT_END, GetParam()}});
  EXPECT_TRUE(spin_until(executor, [&] { return heard == "here"; })) << process.err();
  const CommandResult ended = process.wait();
  EXPECT_EQ(ended.exit_code, 7) << "signal " << ended.signal << "\n" << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_TRUE(spin_until(executor, [&] { return subscription->get_publisher_count() == 0; }));
  EXPECT_EQ(heard, "here");
}

INSTANTIATE_TEST_SUITE_P(Ways, EndOfProcess,
                         testing::Values("static", "shutdown", "leaked", "thread", "callback", "fork"),
                         [](const auto& way) { return way.param; });

}  // namespace
