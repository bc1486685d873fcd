// SPDX-License-Identifier: Apache-2.0
// Which callback of its thread holds up another one.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

// A timer of 1,000 ns (callback 0xaa), one of 10,000 ns (0xbb), and a subscription to /topic (0xcb) in process 71.
class HoldUpsTest : public ::testing::Test {
 protected:
  HoldUpsTest() {
    feed(ros2::RclNodeInit{1, 0, "node", "/"});
    feed(ros2::RclTimerInit{5, 1'000})(ros2::RclcppTimerCallbackAdded{5, 0xaa})(ros2::RclcppTimerLinkNode{5, 1});
    feed(ros2::RclTimerInit{6, 10'000})(ros2::RclcppTimerCallbackAdded{6, 0xbb})(ros2::RclcppTimerLinkNode{6, 1});
    feed(ros2::RmwSubscriptionInit{2, {}})(ros2::RclSubscriptionInit{12, 1, 2, "/topic", 2});
    feed(ros2::RclcppSubscriptionInit{12, 22})(ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
    feed.in(72, 72)(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{11, 1, 1, "/topic", 10});
  }
  void run(ros2::Handle callback, std::int64_t begin_ns, std::int64_t end_ns, std::int64_t thread = 71) {
    feed.in(71, thread).at(begin_ns)(ros2::CallbackStart{callback, false}).at(end_ns)(ros2::CallbackEnd{callback});
  }
  CallbackResult result(ros2::Handle callback) {
    for (const CallbackResult& one : feed.results().callbacks) {
      if (one.address == callback) {
        return one;
      }
    }
    throw std::runtime_error("no such callback");
  }
  Feed feed;
};

TEST_F(HoldUpsTest, OfATimerThatWasDue) {
  run(0xaa, 10'000, 10'100);
  run(0xbb, 10'200, 14'000);
  run(0xaa, 14'010, 14'100);
  const CallbackResult timer = result(0xaa);
  EXPECT_EQ(timer.held_up_by, "/node, timer 10 us");
  EXPECT_EQ(timer.held_up, 1u);
  EXPECT_EQ(timer.held_up_ns, 14'000 - 11'000);
}

TEST_F(HoldUpsTest, BehindACallbackWhoseEndIsLost) {
  feed.at(9'000)(ros2::CallbackStart{0xcb, false});
  run(0xaa, 10'000, 10'100);
  run(0xbb, 10'200, 14'000);
  run(0xaa, 14'010, 14'100);
  EXPECT_EQ(result(0xaa).held_up_by, "/node, timer 10 us");
}

TEST_F(HoldUpsTest, ByACallbackThatSpunAndRanOthers) {
  run(0xaa, 10'000, 10'100);
  feed.at(10'200)(ros2::CallbackStart{0xbb, false});
  run(0xcb, 10'300, 12'000);
  feed.at(14'000)(ros2::CallbackEnd{0xbb});
  run(0xaa, 14'010, 14'100);
  EXPECT_EQ(result(0xaa).held_up_by, "/node, timer 10 us");
  EXPECT_EQ(result(0xaa).held_up_ns, 14'000 - 11'000);
}

TEST_F(HoldUpsTest, OfAMessageThatWasThere) {
  run(0xaa, 10'000, 13'000);
  run(0xbb, 10'100, 12'000, 73);  // of another thread
  feed.in(72, 72).at(11'000)(ros2::RmwPublish{1, 9, 777});
  feed.in(71, 71).at(13'100)(ros2::RmwTake{2, 9, 777, true});
  run(0xcb, 13'200, 13'300);
  const CallbackResult subscription = result(0xcb);
  EXPECT_EQ(subscription.held_up_by, "/node, timer 1 us");
  EXPECT_EQ(subscription.held_up_ns, 2'000);
}

TEST_F(HoldUpsTest, IsNoneByItselfAndNoneInTime) {
  run(0xbb, 10'000, 10'100);
  run(0xaa, 10'200, 13'000);
  run(0xaa, 13'100, 13'200);
  EXPECT_EQ(result(0xaa).held_up, 0u);
  EXPECT_EQ(result(0xaa).held_up_by, "");
}

}  // namespace
}  // namespace tracing
