// SPDX-License-Identifier: Apache-2.0
// What became of messages: the parts of their latency, and the places where they got lost.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

// Process 71 publishes /topic (rmw 1, rcl 11); process 72 subscribes (rmw 2, callback 0xcb) with room for two messages.
class Deliveries : public ::testing::Test {
 protected:
  Deliveries() {
    feed.in(71, 71)(ros2::RclNodeInit{1, 0, "talker", "/"})(ros2::RmwPublisherInit{1, {}});
    feed(ros2::RclPublisherInit{11, 1, 1, "/topic", 10});
    feed.in(72, 72)(ros2::RclNodeInit{1, 0, "listener", "/"})(ros2::RmwSubscriptionInit{2, {}});
    feed(ros2::RclSubscriptionInit{12, 1, 2, "/topic", 2});
    feed(ros2::RclcppSubscriptionInit{12, 22})(ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
  }
  void publish(std::int64_t time_ns, std::int64_t number) {
    feed.in(71, 71).at(time_ns)(ros2::RmwPublish{1, 9, number});
  }
  void receive(std::int64_t time_ns, std::int64_t number) {
    feed.in(72, 72).at(time_ns)(ros2::RmwTake{2, 9, number, true});
    feed.at(time_ns + 5)(ros2::CallbackStart{0xcb, false}).at(time_ns + 9)(ros2::CallbackEnd{0xcb});
  }
  SubscriptionResult result() {
    const Ros2Results results = feed.results();
    EXPECT_EQ(results.subscriptions.size(), 1u);
    return results.subscriptions.at(0);
  }
  Feed feed;
};

TEST(DeliveriesOfAnUnknownNode, BelongToTheProcessThatTookThem) {
  Feed feed;
  feed.in(71, 71)(ros2::RclNodeInit{1, 0, "talker", "/"})(ros2::RmwPublisherInit{1, {}});
  feed(ros2::RclPublisherInit{11, 1, 1, "/topic", 10}).at(1'000)(ros2::RmwPublish{1, 9, 777});
  feed.in(72, 72)(ros2::RmwSubscriptionInit{2, {}})(ros2::RclSubscriptionInit{12, 1, 2, "/topic", 2});
  feed(ros2::RclcppSubscriptionInit{12, 22})(ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
  feed.at(1'100)(ros2::RmwTake{2, 9, 777, true});
  feed.at(1'105)(ros2::CallbackStart{0xcb, false}).at(1'109)(ros2::CallbackEnd{0xcb});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.subscriptions.size(), 1u);
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.subscriptions[0].node, "");
  EXPECT_EQ(results.subscriptions[0].process, results.callbacks[0].process);
  EXPECT_NE(results.subscriptions[0].process, results.nodes.at(0).process);
}

TEST_F(Deliveries, DivideTheTimeOfAMessageThatTheExecutorWaitsFor) {
  feed.in(72, 72).at(1'000)(ros2::RclcppExecutorWaitForWork{-1});
  feed.in(71, 71).at(2'000)(ros2::RclcppPublish{9}).at(2'001)(ros2::RclPublish{11, 9});
  feed.at(2'004)(ros2::RmwPublish{1, 9, 777});
  feed.in(72, 72).at(2'104)(ros2::RclcppExecutorGetNextReady{}).at(2'124)(ros2::RmwTake{2, 8, 777, true});
  feed.at(2'130)(ros2::CallbackStart{0xcb, false}).at(2'150)(ros2::CallbackEnd{0xcb});
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.node, "/listener");
  EXPECT_EQ(subscription.topic, "/topic");
  EXPECT_EQ(subscription.queue_depth, 2u);
  EXPECT_EQ(subscription.rclcpp.max_ns, 1);
  EXPECT_EQ(subscription.rcl.max_ns, 3);
  EXPECT_EQ(subscription.transport.max_ns, 100);
  EXPECT_EQ(subscription.executor.max_ns, 20);
  EXPECT_EQ(subscription.take.max_ns, 6);
  EXPECT_EQ(subscription.latency.max_ns, 1 + 3 + 100 + 20 + 6);
}

TEST_F(Deliveries, CountTheTimeOfABusyExecutorForIt) {
  feed.in(72, 72).at(1'000)(ros2::RclcppExecutorWaitForWork{-1}).at(1'100)(ros2::RclcppExecutorGetNextReady{});
  publish(2'000, 777);
  feed.in(72, 72).at(5'000)(ros2::RclcppExecutorWaitForWork{-1}).at(5'010)(ros2::RclcppExecutorGetNextReady{});
  receive(5'030, 777);
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.transport.max_ns, 10);
  EXPECT_EQ(subscription.executor.max_ns, 3'000 + 20);
  EXPECT_EQ(subscription.latency.max_ns, 3'035);
}

// Both messages come late, and together. Between their callbacks the thread asks for more work, without a wait.
TEST_F(Deliveries, CountEachWaitOfTheExecutorForMessagesThatArriveTogether) {
  feed.in(72, 72).at(1'000)(ros2::RclcppExecutorWaitForWork{-1});
  publish(2'000, 777);
  publish(3'000, 778);
  feed.in(72, 72).at(503'000)(ros2::RclcppExecutorGetNextReady{});
  receive(503'010, 777);
  feed.at(503'030)(ros2::RclcppExecutorWaitForWork{-1}).at(503'035)(ros2::RclcppExecutorGetNextReady{});
  receive(503'040, 778);
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.executor.min_ns, 10);
  EXPECT_EQ(subscription.executor.max_ns, 35);
  EXPECT_EQ(subscription.transport.min_ns, 500'005);
  EXPECT_EQ(subscription.transport.max_ns, 501'000);
}

// Thread 73 waits; thread 72 wants to look for work meanwhile.
TEST_F(Deliveries, CountTheWaitOfAnotherThreadOfTheExecutor) {
  feed.in(72, 72).at(900)(ros2::RclcppExecutorGetNextReady{});
  feed.in(72, 73).at(1'000)(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorWaitForWork{-1});
  publish(2'000, 777);
  feed.in(72, 73).at(9'000)(ros2::RclcppExecutorGetNextReady{});
  feed.in(72, 72).at(9'010)(ros2::RclcppExecutorGetNextReady{});
  receive(9'020, 777);
  EXPECT_EQ(result().transport.max_ns, 7'000);
}

TEST_F(Deliveries, DontTakeTheWaitOfAnotherExecutorForAWaitForThem) {
  feed.in(72, 72).at(900)(ros2::RclcppExecutorWaitForWork{-1});
  feed.in(72, 73).at(1'000)(ros2::RclcppExecutorWaitForWork{-1});
  feed.in(72, 72).at(1'100)(ros2::RclcppExecutorGetNextReady{});
  publish(2'000, 777);
  feed.in(72, 72).at(8'000)(ros2::RclcppExecutorGetNextReady{});
  receive(8'020, 777);
  EXPECT_EQ(result().executor.max_ns, 6'020);
}

// Its callbacks take turns: thread 72 runs one from 1,020 to 7,000, while thread 73 waits for other work.
TEST_F(Deliveries, CountTheTimeOfTheCallbackBeforeAsAWaitForTheExecutor) {
  publish(500, 776);
  feed.in(72, 73).at(990)(ros2::RclcppExecutorGetNextReady{});
  feed.in(72, 72).at(1'000)(ros2::RclcppExecutorGetNextReady{})(ros2::RmwTake{2, 9, 776, true});
  feed.in(72, 72).at(1'020)(ros2::CallbackStart{0xcb, false});
  feed.in(72, 73).at(1'030)(ros2::RclcppExecutorWaitForWork{-1});
  publish(2'000, 777);
  feed.in(72, 72).at(7'000)(ros2::CallbackEnd{0xcb});
  feed.in(72, 73).at(7'100)(ros2::RclcppExecutorGetNextReady{});
  feed.in(72, 72).at(7'110)(ros2::RclcppExecutorGetNextReady{});
  receive(7'120, 777);
  EXPECT_EQ(result().executor.max_ns, 5'020);
}

TEST_F(Deliveries, DontDivideTheTimeWithoutAnExecutorThatTells) {
  publish(2'000, 777);
  receive(2'100, 777);
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.latency.max_ns, 105);
  EXPECT_EQ(subscription.transport.count, 0u);
  EXPECT_EQ(subscription.executor.count, 0u);
  EXPECT_EQ(subscription.take.max_ns, 5);
}

TEST_F(Deliveries, TellWhereMessagesGotLost) {
  feed.in(72, 72).at(10)(ros2::RclcppExecutorWaitForWork{-1}).at(20)(ros2::RclcppExecutorGetNextReady{});
  publish(100, 1);  // before the subscription is connected
  publish(200, 2);
  receive(250, 2);
  for (const std::int64_t number : {3, 4, 5, 6}) {
    publish(300 + number, number);
  }
  receive(400, 5);  // 3 and 4 did not fit any more
  receive(420, 6);
  publish(500, 7);
  publish(600, 8);
  receive(650, 8);  // 7 would have fitted
  feed.in(72, 72).at(700)(ros2::RmwTake{2, 9, 8, true})(ros2::RclcppExecutorWaitForWork{-1});
  publish(800, 9);
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.received, 5u);
  EXPECT_EQ(subscription.delivered, 4u);
  EXPECT_EQ(subscription.not_executed, 1u);
  EXPECT_EQ(subscription.before_first, 1u);
  EXPECT_EQ(subscription.overwritten, 2u);
  EXPECT_EQ(subscription.lost, 1u);
  EXPECT_EQ(subscription.after_last, 1u);
  EXPECT_EQ(subscription.dropped(), 4u);
}

// The client of an action, for example, takes its feedback in a waitable, which has no callback of its own.
TEST_F(Deliveries, ReachASubscriptionThatAWaitableServes) {
  feed.in(72, 72)(ros2::RmwSubscriptionInit{3, {}})(ros2::RclSubscriptionInit{13, 1, 3, "/topic", 2});
  publish(1'000, 777);
  feed.in(72, 72).at(1'100)(ros2::RmwTake{3, 9, 777, true})(ros2::RclcppExecutorWaitForWork{-1});
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.delivered, 1u);
  EXPECT_EQ(subscription.dropped(), 0u);
}

TEST_F(Deliveries, ReachAProgramThatTakesThemItself) {
  publish(1'000, 777);
  publish(1'010, 778);
  feed.in(72, 72).at(1'100)(ros2::RclcppExecutorExecute{99})(ros2::RmwTake{2, 9, 777, true});
  feed(ros2::RclcppExecutorWaitForWork{-1})(ros2::RclcppExecutorExecute{12})(ros2::RmwTake{2, 9, 778, true});
  feed(ros2::RclcppExecutorWaitForWork{-1});
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.delivered, 1u);
  EXPECT_EQ(subscription.not_executed, 1u) << "the executor took it for a callback, which did not run";
}

// The callback of message 1 takes 2 and 3, and gets 4 with the next look for work.
TEST_F(Deliveries, ReachACallbackThatTakesTheRestItself) {
  for (const std::int64_t number : {1, 2, 3, 4}) {
    publish(1'000 + number, number);
  }
  feed.in(72, 72).at(1'100)(ros2::RclcppExecutorExecute{12})(ros2::RmwTake{2, 9, 1, true});
  feed(ros2::CallbackStart{0xcb, false})(ros2::RmwTake{2, 9, 2, true})(ros2::RmwTake{2, 9, 3, true});
  feed(ros2::CallbackEnd{0xcb})(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorExecute{12});
  feed(ros2::RmwTake{2, 9, 4, true})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.delivered, 4u);
  EXPECT_EQ(subscription.not_executed, 0u);
}

// Message 2 gets lost although the queue of the subscription has room.
class LostMessage : public Deliveries {
 protected:
  using Kind = ros2::EndpointQosEvent::Kind;
  void has_qos(const ros2::EndpointQos& publisher, const ros2::EndpointQos& subscription) {
    feed.in(71, 71).has_qos(Kind::kPublisher, 1, publisher);
    feed.in(72, 72).has_qos(Kind::kSubscription, 2, subscription);
  }
  SubscriptionResult after_loss() {
    for (const std::int64_t number : {1, 2, 3}) {
      publish(100 * number, number);
    }
    receive(150, 1);
    receive(350, 3);
    return result();
  }
};

TEST_F(LostMessage, OfReliableEndpointsWasPushedOutByThePublisher) {
  has_qos({true, 10, false}, {true, 2, false});
  const SubscriptionResult subscription = after_loss();
  EXPECT_EQ(subscription.lost, 1u);
  EXPECT_EQ(subscription.lost_by_publisher, 1u);
  EXPECT_EQ(subscription.lost_in_transport, 0u);
}

TEST_F(LostMessage, OfABestEffortSideGotLostInTheTransport) {
  has_qos({true, 10, false}, {false, 2, false});
  const SubscriptionResult subscription = after_loss();
  EXPECT_EQ(subscription.lost, 1u);
  EXPECT_EQ(subscription.lost_by_publisher, 0u);
  EXPECT_EQ(subscription.lost_in_transport, 1u);
  EXPECT_EQ(subscription.dropped(), 1u);
}

TEST_F(LostMessage, MayBeFiltered) {
  has_qos({true, 10, false}, {true, 2, true});
  const SubscriptionResult subscription = after_loss();
  EXPECT_EQ(subscription.filtered, 1u);
  EXPECT_EQ(subscription.lost, 0u);
  EXPECT_EQ(subscription.dropped(), 0u) << "that is what the filter is for";
}

TEST_F(LostMessage, OfAFilterIsNotPushedOut) {
  has_qos({true, 10, false}, {true, 1, true});
  for (const std::int64_t number : {1, 2, 3}) {
    publish(100 * number, number);
  }
  receive(350, 1);
  receive(360, 3);
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.overwritten, 0u);
  EXPECT_EQ(subscription.filtered, 1u);
}

TEST_F(LostMessage, IsNotPlacedIfOneSideIsUnknown) {
  feed.in(72, 72).has_qos(Kind::kSubscription, 2, {true, 2, false});
  EXPECT_EQ(after_loss().lost_unplaced(), 1u);
}

TEST_F(Deliveries, AreNotPushedOutOfAQueueThatKeepsAll) {
  feed.in(72, 72).has_qos(ros2::EndpointQosEvent::Kind::kSubscription, 2, {true, 0, false});
  for (const std::int64_t number : {1, 2, 3, 4, 5}) {
    publish(100 + number, number);
  }
  receive(150, 1);
  receive(160, 5);
  const SubscriptionResult subscription = result();
  EXPECT_EQ(subscription.overwritten, 0u);
  EXPECT_EQ(subscription.lost, 3u);
}

TEST_F(Deliveries, GiveTheRateOfATopic) {
  for (int i = 0; i < 11; ++i) {
    publish(1'000'000'000 + i * 100'000'000, i + 1);
  }
  const Ros2Results results = feed.results();
  const TopicResult& topic = testing::topic(results, "/topic");
  EXPECT_DOUBLE_EQ(topic.rate_hz, 10);
  EXPECT_EQ(topic.interval.count, 10u);
  EXPECT_EQ(topic.interval.min_ns, 100'000'000);
}

}  // namespace
}  // namespace tracing
