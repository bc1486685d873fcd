// SPDX-License-Identifier: Apache-2.0
// Messages that stay within their process.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

// A publisher (rcl 11) and an intra-process subscription (object 22, buffer 50, callback 0xcb) of /topic.
Feed intra_process_feed() {
  Feed feed;
  feed(ros2::RclNodeInit{1, 0, "both", "/"})(ros2::RmwPublisherInit{1, {}});
  feed(ros2::RclPublisherInit{11, 1, 1, "/topic", 2});
  feed(ros2::RmwSubscriptionInit{2, {}})(ros2::RclSubscriptionInit{12, 1, 2, "/topic", 2});
  feed(ros2::RclcppConstructRingBuffer{50, 2})(ros2::RclcppBufferToIpb{50, 60})(ros2::RclcppIpbToSubscription{60, 22});
  feed(ros2::RclcppSubscriptionCallbackAdded{22, 0xcb})(ros2::RclcppSubscriptionInit{12, 22});
  return feed;
}

TEST(IntraProcess, MessagesAreFollowedThroughTheBuffer) {
  Feed feed = intra_process_feed();
  feed.at(1'000)(ros2::RclcppIntraPublish{11, 9}).at(1'010)(ros2::RclcppRingBufferEnqueue{50, 0, 1, false});
  feed.in(71, 80).at(1'100)(ros2::RclcppRingBufferDequeue{50, 0, 0});
  feed.at(1'107)(ros2::CallbackStart{0xcb, true})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.subscriptions.size(), 1u);
  const SubscriptionResult& subscription = results.subscriptions[0];
  EXPECT_EQ(subscription.received, 1u);
  EXPECT_EQ(subscription.intra_process, 1u);
  EXPECT_EQ(subscription.latency.max_ns, 107);
  EXPECT_EQ(subscription.take.max_ns, 7);
  EXPECT_EQ(testing::topic(results, "/topic").intra_process_published, 1u);
  EXPECT_EQ(testing::topic(results, "/topic").intra_process_received, 1u);
  EXPECT_EQ(testing::topic(results, "/topic").published, 0u);
}

TEST(IntraProcess, MessagesThatAreOverwrittenCount) {
  Feed feed = intra_process_feed();
  std::uint64_t index = 0;
  for (const bool overwritten : {false, false, true}) {
    feed(ros2::RclcppIntraPublish{11, 9})(ros2::RclcppRingBufferEnqueue{50, index++ % 2, 1, overwritten});
  }
  feed(ros2::RclcppRingBufferDequeue{50, 1, 1})(ros2::CallbackStart{0xcb, true})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  EXPECT_EQ(results.subscriptions.at(0).overwritten_in_buffer, 1u);
  EXPECT_EQ(results.subscriptions.at(0).latency.max_ns, 50);  // of the second message
  ASSERT_EQ(results.unmatched.size(), 1u);
  EXPECT_EQ(results.unmatched[0].event, "rclcpp_ring_buffer_enqueue");
}

// `ros2_ext` records the end of the subscription, and another one gets its address.
TEST(IntraProcess, MessagesThatAreOverwrittenCountForASubscriptionThatIsGoneAtTheEnd) {
  Feed feed = intra_process_feed();
  for (const bool overwritten : {false, false, true, true}) {
    feed(ros2::RclcppIntraPublish{11, 9})(ros2::RclcppRingBufferEnqueue{50, 0, 1, overwritten});
  }
  feed(ros2::RclcppRingBufferDequeue{50, 1, 1})(ros2::CallbackStart{0xcb, true})(ros2::CallbackEnd{0xcb});
  feed.end(ros2::ObjectEnd::Kind::kRclcppSubscription, 22).end(ros2::ObjectEnd::Kind::kRclSubscription, 12);
  feed(ros2::RmwSubscriptionInit{3, {}})(ros2::RclSubscriptionInit{13, 1, 3, "/other", 2});
  feed(ros2::RclcppSubscriptionInit{13, 22});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.subscriptions.size(), 1u);
  EXPECT_EQ(results.subscriptions[0].topic, "/topic");
  EXPECT_EQ(results.subscriptions[0].overwritten_in_buffer, 2u);
}

TEST(IntraProcess, ASubscriptionWhoseMessagesWereAllOverwrittenIsThere) {
  Feed feed = intra_process_feed();
  feed(ros2::RclcppIntraPublish{11, 9})(ros2::RclcppRingBufferEnqueue{50, 0, 1, true});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.subscriptions.size(), 1u);
  EXPECT_EQ(results.subscriptions[0].received, 0u);
  EXPECT_EQ(results.subscriptions[0].dropped(), 1u);
}

// rclcpp has one object for each way. It drops what comes through the middleware from its own process.
TEST(IntraProcess, TheSecondCopyOfAMessageIsNotDropped) {
  Feed feed = intra_process_feed();
  feed(ros2::RclcppSubscriptionInit{12, 21})(ros2::RclcppIntraPublish{11, 9});
  feed(ros2::RclcppRingBufferEnqueue{50, 0, 1, false})(ros2::RmwPublish{1, 9, 70});
  feed(ros2::RclcppExecutorExecute{12})(ros2::RmwTake{2, 8, 70, true})(ros2::RclcppExecutorWaitForWork{-1});
  feed(ros2::RclcppRingBufferDequeue{50, 0, 0})(ros2::CallbackStart{0xcb, true})(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.subscriptions.size(), 1u);
  EXPECT_EQ(results.subscriptions[0].received, 1u);
  EXPECT_EQ(results.subscriptions[0].dropped(), 0u);
}

// Such as what a node publishes about its parameters when it starts.
TEST(IntraProcess, ABurstHasNoRate) {
  Feed feed = intra_process_feed();
  for (int i = 0; i < 3; ++i) {
    feed.at(1'000'000'000 + i * 1'000'000)(ros2::RmwPublish{1, 9, 70 + i});
    feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  }
  feed.at(2'000'000'000)(ros2::RclcppExecutorWaitForWork{-1});
  const Ros2Results results = feed.results();
  EXPECT_EQ(testing::topic(results, "/topic").rate_hz, 0);
  EXPECT_EQ(results.callbacks.at(0).rate_hz, 0);
  EXPECT_EQ(testing::topic(results, "/topic").interval.p50_ns, 1'000'000);
}

TEST(IntraProcess, AMessageThatGoesBothWaysCountsOnceForTheRate) {
  Feed feed = intra_process_feed();
  for (int i = 0; i < 3; ++i) {
    feed.at(1'000'000'000 + i * 500'000'000)(ros2::RclcppIntraPublish{11, 9})(ros2::RmwPublish{1, 9, 70 + i});
  }
  const Ros2Results results = feed.results();
  EXPECT_DOUBLE_EQ(testing::topic(results, "/topic").rate_hz, 2);
  EXPECT_EQ(testing::topic(results, "/topic").interval.count, 2u);
}

}  // namespace
}  // namespace tracing
