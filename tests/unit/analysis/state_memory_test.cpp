// SPDX-License-Identifier: Apache-2.0
// The memory that lifecycle nodes ask for in their states.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

TEST(StateMemory, IsCountedForTheNodeAndForItsProcess) {
  Feed feed;
  feed.allocates(1'000);
  feed(ros2::RclNodeInit{1, 0, "node", "/"})(ros2::RclLifecycleStateMachineInit{1, 0x5});
  feed(ros2::RclTimerInit{3, 100})(ros2::RclcppTimerCallbackAdded{3, 0xe})(ros2::RclcppTimerLinkNode{3, 1});
  feed.allocates(8);
  feed(ros2::RclLifecycleTransition{0x5, "unconfigured", "active"});
  feed(ros2::CallbackStart{0xe, false}).allocates(32).allocates(4)(ros2::CallbackEnd{0xe}).allocates(16);
  feed(ros2::RclLifecycleTransition{0x5, "active", "inactive"});
  feed(ros2::CallbackStart{0xe, false}).allocates(2)(ros2::CallbackEnd{0xe});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.lifecycle.size(), 3u);
  EXPECT_EQ(results.lifecycle[0].state, "unconfigured");
  EXPECT_EQ(results.lifecycle[0].allocations, 0u);
  EXPECT_EQ(results.lifecycle[0].process_allocations, 1u) << "not what came before the state";
  EXPECT_EQ(results.lifecycle[1].state, "active");
  EXPECT_EQ(results.lifecycle[1].allocations, 2u);
  EXPECT_EQ(results.lifecycle[1].allocated_bytes, 36u);
  EXPECT_EQ(results.lifecycle[1].process_allocations, 3u);
  EXPECT_EQ(results.lifecycle[1].process_allocated_bytes, 52u);
  EXPECT_EQ(results.lifecycle[2].allocations, 1u);
}

TEST(StateMemory, IsUnknownWithoutItsEvents) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 0, "node", "/"})(ros2::RclLifecycleStateMachineInit{1, 0x5});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.lifecycle.size(), 1u);
  EXPECT_EQ(results.lifecycle[0].allocations, std::nullopt);
}

}  // namespace
}  // namespace tracing
