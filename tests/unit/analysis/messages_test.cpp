// SPDX-License-Identifier: Apache-2.0
// The way of messages from the publisher to the callback.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;
using testing::topic;

// A publisher (rmw 1) and a subscription (rmw 2, callback 0xcb) of /topic in process 71.
Feed topic_feed() {
  Feed feed;
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{11, 0, 1, "/topic", 1});
  feed(ros2::RmwSubscriptionInit{2, {}})(ros2::RclSubscriptionInit{12, 0, 2, "/topic", 1});
  feed(ros2::RclcppSubscriptionInit{12, 22})(ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
  return feed;
}

TEST(Messages, IgnoresATakeThatTookNothing) {
  Feed feed = topic_feed();
  feed(ros2::RmwPublish{1, 9, 777});
  feed(ros2::RmwTake{2, 9, 777, false})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").received, 0u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 0u);
  EXPECT_EQ(topic(results, "/topic").published_only, 1u);
}

TEST(Messages, CountsAMessageThatNobodyReceives) {
  Feed feed = topic_feed();
  feed(ros2::RmwPublish{1, 9, 777})(ros2::RmwPublish{1, 9, 778});
  feed(ros2::RmwTake{2, 9, 778, true})(ros2::CallbackStart{0xcb, false});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").published, 2u);
  EXPECT_EQ(topic(results, "/topic").published_only, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.max_ns, 30 - 10);
}

TEST(Messages, CountsAMessageFromOutsideTheTrace) {
  Feed feed = topic_feed();
  feed(ros2::RmwTake{2, 9, 555, true})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").received_only, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 0u);
}

TEST(Messages, GivesATakenMessageToNoOtherCallback) {
  Feed feed = topic_feed();
  feed(ros2::RclTimerInit{3, 100})(ros2::RclcppTimerCallbackAdded{3, 0xee});
  feed(ros2::RmwPublish{1, 9, 777})(ros2::RmwTake{2, 9, 777, true});
  feed(ros2::CallbackStart{0xee, false})(ros2::CallbackEnd{0xee});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").received, 1u);
  EXPECT_EQ(topic(results, "/topic").latency.count, 0u);
}

TEST(Messages, TellsInternalHandlesFromUnknownOnes) {
  Feed feed;
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RmwSubscriptionInit{2, {}});
  feed(ros2::RmwPublish{1, 9, 777})(ros2::RmwTake{2, 9, 0, true})(ros2::RmwTake{2, 9, 0, false});
  feed(ros2::RmwPublish{4, 9, 778})(ros2::RmwTake{5, 9, 778, true});
  const Ros2Results results = feed.results();
  EXPECT_EQ(results.internal_messages, 2u);
  EXPECT_EQ(results.unknown_messages, 2u);
  EXPECT_TRUE(results.topics.empty());
}

TEST(Messages, FindsThePublisherOfOlderEventsThroughRcl) {
  Feed feed = topic_feed();
  feed(ros2::RclPublish{11, 9})(ros2::RmwPublish{0, 9, 0});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").published, 1u);
  EXPECT_EQ(results.unknown_messages, 0u);
}

TEST(Messages, TellsThatClocksDifferWhenAMessageIsTakenBeforeItIsPublished) {
  Feed feed = topic_feed();
  feed.at(1'000)(ros2::RmwTake{2, 9, 777, true})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed.at(1'500)(ros2::RmwPublish{1, 9, 777});
  feed.at(2'000)(ros2::RmwTake{2, 9, 555, true});  // its publication is not in the trace
  const TopicResult result = topic(feed.results(), "/topic");
  EXPECT_EQ(result.received, 2u);
  EXPECT_EQ(result.received_only, 1u);
  EXPECT_EQ(result.published_only, 0u);
  EXPECT_EQ(result.early, 1u);
  EXPECT_EQ(result.earliest_ns, 500);
  EXPECT_EQ(result.latency.count, 0u) << "it would be wrong";
  EXPECT_TRUE(result.doubtful);
}

}  // namespace
}  // namespace tracing
