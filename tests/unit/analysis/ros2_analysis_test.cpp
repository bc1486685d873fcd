// SPDX-License-Identifier: Apache-2.0
// The owner and the duration of callbacks.
#include <gtest/gtest.h>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;
using Owner = CallbackResult::Owner;

TEST(Ros2Analysis, FollowsPingAndPong) {
  Ros2Analysis analysis;
  for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
    analysis.on_event({time, static_cast<ProcessId>(thread.vpid), thread.vtid}, event);
  }
  const Ros2Results results = analysis.finish();

  ASSERT_EQ(results.callbacks.size(), 3u);
  const CallbackResult& pong_in_ping = results.callbacks[0];
  EXPECT_EQ(pong_in_ping.process, 71);
  EXPECT_EQ(pong_in_ping.node, "/ping");
  EXPECT_EQ(pong_in_ping.owner, Owner::kSubscription);
  EXPECT_EQ(pong_in_ping.owner_name, "/pong");
  EXPECT_EQ(pong_in_ping.symbol, "Ping::?(std::shared_ptr<std_msgs::msg::String>)");
  EXPECT_EQ(pong_in_ping.durations.count, 1u);
  EXPECT_EQ(pong_in_ping.durations.max_ns, 30'000);
  const CallbackResult& timer = results.callbacks[1];
  EXPECT_EQ(timer.node, "/ping");
  EXPECT_EQ(timer.owner, Owner::kTimer);
  EXPECT_EQ(timer.period_ns, 500'000'000);
  EXPECT_EQ(timer.durations.max_ns, 60'000);
  EXPECT_EQ(timer.unfinished, 0u);
  EXPECT_EQ(results.callbacks[2].process, 72);
  EXPECT_EQ(results.callbacks[2].node, "/pong");
  EXPECT_EQ(results.callbacks[2].owner_name, "/ping");

  ASSERT_EQ(results.topics.size(), 2u);
  const TopicResult& ping = results.topics[0];
  EXPECT_EQ(ping.name, "/ping");
  EXPECT_EQ(ping.publishers, 1u);
  EXPECT_EQ(ping.subscriptions, 1u);
  EXPECT_EQ(ping.published, 1u);
  EXPECT_EQ(ping.received, 1u);
  EXPECT_EQ(ping.published_only, 0u);
  EXPECT_EQ(ping.received_only, 0u);
  EXPECT_EQ(ping.latency.count, 1u);
  EXPECT_EQ(ping.latency.max_ns, 150'000) << "rmw_publish at 506.920 ms, callback_start at 507.070 ms";
  EXPECT_EQ(results.topics[1].latency.max_ns, 115'000);
  EXPECT_EQ(results.internal_messages, 2u) << "discovery: one published, one taken";
  EXPECT_EQ(results.unknown_messages, 0u);
}

TEST(Ros2Analysis, KeepsEqualAddressesOfTwoProcessesApart) {
  Feed feed;
  feed.in(71, 71)(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb});
  feed.in(72, 72)(ros2::RclTimerInit{1, 200})(ros2::RclcppTimerCallbackAdded{1, 0xcb});
  feed.in(71, 71)(ros2::CallbackStart{0xcb, false});
  feed.in(72, 72)(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed.in(71, 71)(ros2::CallbackEnd{0xcb});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].period_ns, 100);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 30);
  EXPECT_EQ(results.callbacks[1].period_ns, 200);
  EXPECT_EQ(results.callbacks[1].durations.max_ns, 10);
}

TEST(Ros2Analysis, KeepsAReentrantCallbackInTwoThreadsApart) {
  Feed feed;
  feed.in(71, 1)(ros2::CallbackStart{0xcb, false});
  feed.in(71, 2)(ros2::CallbackStart{0xcb, false});
  feed.in(71, 1)(ros2::CallbackEnd{0xcb});
  feed.in(71, 2)(ros2::CallbackEnd{0xcb});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].durations.count, 2u);
  EXPECT_EQ(results.callbacks[0].durations.min_ns, 20);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 20);
}

TEST(Ros2Analysis, CountsACallbackThatNeverEnds) {
  Feed feed;
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::CallbackStart{0xcb, false});  // an exception leaves it without an end
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::CallbackStart{0xcb, false});  // it still runs when the trace ends
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].durations.count, 2u);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 10);
  EXPECT_EQ(results.callbacks[0].unfinished, 2u);
}

TEST(Ros2Analysis, IgnoresAnEndWhoseStartIsNotInTheTrace) {
  Feed feed;
  feed(ros2::CallbackEnd{0xcb});
  EXPECT_TRUE(feed.results().callbacks.empty());
}

TEST(Ros2Analysis, MeasuresACallbackWithinAnother) {
  Feed feed;
  feed(ros2::CallbackStart{1, false})(ros2::CallbackStart{2, false})(ros2::CallbackEnd{2})(ros2::CallbackEnd{1});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].durations.max_ns, 30);
  EXPECT_EQ(results.callbacks[1].durations.max_ns, 10);
}

TEST(Ros2Analysis, AttributesTheCallbackThatIsAnnouncedBeforeItsSubscriptionObject) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 2, "node", "/ns"});
  feed(ros2::RmwSubscriptionInit{3, {}})(ros2::RclSubscriptionInit{4, 1, 3, "/topic", 1});
  // With intra-process communication there are two objects; the callback of the first one comes first.
  feed(ros2::RclcppSubscriptionCallbackAdded{5, 0xa})(ros2::RclcppCallbackRegister{0xa, "f"});
  feed(ros2::RclcppSubscriptionInit{4, 5})(ros2::RclcppSubscriptionInit{4, 6});
  feed(ros2::RclcppSubscriptionCallbackAdded{6, 0xb})(ros2::RclcppCallbackRegister{0xb, "f"});
  feed(ros2::CallbackStart{0xa, true})(ros2::CallbackEnd{0xa});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].node, "/ns/node");
  EXPECT_EQ(results.callbacks[0].owner_name, "/topic");
  EXPECT_EQ(results.callbacks[0].intra_process, 1u);
}

TEST(Ros2Analysis, AttributesServiceCallbacks) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 2, "node", "/"})(ros2::RclServiceInit{3, 1, 4, "/add"});
  feed(ros2::RclcppServiceCallbackAdded{3, 0xc})(ros2::RclcppCallbackRegister{0xc, "(null)"});
  feed(ros2::CallbackStart{0xc, false})(ros2::CallbackEnd{0xc});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].owner, Owner::kService);
  EXPECT_EQ(results.callbacks[0].owner_name, "/add");
  EXPECT_EQ(results.callbacks[0].node, "/node");
  EXPECT_EQ(results.callbacks[0].symbol, "");
}

}  // namespace
}  // namespace tracing
