// SPDX-License-Identifier: Apache-2.0
// The object of an event when addresses are used again.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;
using testing::topic;
using Owner = CallbackResult::Owner;

TEST(ObjectIdentity, GivesAReusedAddressToTheNewestObject) {
  Feed feed;
  feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(
      ros2::RclcppCallbackRegister{0xcb, "first"});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::RclTimerInit{1, 200})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(
      ros2::RclcppCallbackRegister{0xcb, "second"});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].symbol, "first");
  EXPECT_EQ(results.callbacks[0].period_ns, 100);
  EXPECT_EQ(results.callbacks[0].durations.count, 1u);
  EXPECT_EQ(results.callbacks[1].symbol, "second");
  EXPECT_EQ(results.callbacks[1].period_ns, 200);
  EXPECT_EQ(results.callbacks[1].durations.count, 2u);
}

TEST(ObjectIdentity, TellsAnEqualObjectFromTheOneThatHasEnded) {
  using Kind = ros2::ObjectEnd::Kind;
  Feed feed;
  for (int life = 0; life < 2; ++life) {
    feed(ros2::RclNodeInit{2, 3, "node", "/"});
    feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(ros2::RclcppTimerLinkNode{1, 2});
    feed(ros2::RclcppCallbackRegister{0xcb, "tick"});
    feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
    feed.end(Kind::kRclcppCallback, 0xcb).end(Kind::kRclTimer, 1).end(Kind::kRclNode, 2);
  }

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  for (const CallbackResult& callback : results.callbacks) {
    EXPECT_EQ(callback.node, "/node");
    EXPECT_EQ(callback.symbol, "tick");
    EXPECT_EQ(callback.durations.count, 1u);
  }
}

TEST(ObjectIdentity, GivesTheHandleOfAnEndedObjectToNobody) {
  using Kind = ros2::ObjectEnd::Kind;
  Feed feed;
  feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb});
  feed(ros2::RmwPublisherInit{5, {}})(ros2::RclPublisherInit{6, 0, 5, "/topic", 1})(ros2::RmwPublish{5, 9, 1});
  feed.in(72, 72).end(Kind::kRclcppCallback, 0xcb);  // an event of another process
  feed.in(71, 71)(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  feed.end(Kind::kRclcppCallback, 0xcb).end(Kind::kRclTimer, 1).end(Kind::kRclPublisher, 6).end(Kind::kRmwPublisher, 5);
  feed(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb})(ros2::RmwPublish{5, 9, 2});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].owner, Owner::kUnknown);
  EXPECT_EQ(results.callbacks[0].durations.count, 1u);
  EXPECT_EQ(results.callbacks[1].owner, Owner::kTimer);
  EXPECT_EQ(results.callbacks[1].durations.count, 1u);
  EXPECT_EQ(topic(results, "/topic").published, 1u);
  EXPECT_EQ(results.unknown_messages, 1u);
}

TEST(ObjectIdentity, EndsASubscriptionWithAllItsLayers) {
  using Kind = ros2::ObjectEnd::Kind;
  Feed feed;
  for (std::int64_t life = 1; life <= 2; ++life) {
    feed(ros2::RmwSubscriptionInit{1, {}})(ros2::RclSubscriptionInit{2, 0, 1, "/topic", 1});
    feed(ros2::RclcppSubscriptionInit{2, 3})(ros2::RclcppSubscriptionCallbackAdded{3, 0xcb});
    feed(ros2::RmwTake{1, 9, life, true})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
    feed.end(Kind::kRclcppCallback, 0xcb).end(Kind::kRclcppSubscription, 3).end(Kind::kRclSubscription, 2);
    feed.end(Kind::kRmwSubscription, 1);
  }
  feed(ros2::RmwTake{1, 9, 3, true});

  const Ros2Results results = feed.results();

  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].owner_name, "/topic");
  EXPECT_EQ(results.callbacks[1].owner_name, "/topic");
  EXPECT_EQ(topic(results, "/topic").subscriptions, 2u);
  EXPECT_EQ(topic(results, "/topic").received, 2u);
  EXPECT_EQ(results.unknown_messages, 1u);
}

TEST(ObjectIdentity, GivesAReusedPublisherHandleToTheNewestTopic) {
  Feed feed;
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{2, 0, 1, "/old", 1})(ros2::RmwPublish{1, 9, 1});
  feed(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{2, 0, 1, "/new", 1})(ros2::RmwPublish{1, 9, 2});
  feed(ros2::RmwPublish{1, 9, 3});
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/old").published, 1u);
  EXPECT_EQ(topic(results, "/new").published, 2u);
}

TEST(ObjectIdentity, TellsANewTimerOfAnotherNodeFromARepeatedOne) {
  Feed feed;
  feed(ros2::RclNodeInit{7, 8, "first", "/"})(ros2::RclNodeInit{9, 8, "second", "/"});
  for (const ros2::Handle node : {7, 9}) {
    feed(ros2::RclTimerInit{1, 100})(ros2::RclcppTimerCallbackAdded{1, 0xcb})(
        ros2::RclcppCallbackRegister{0xcb, "tick()"});
    feed(ros2::RclcppTimerLinkNode{1, node})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].node, "/first");
  EXPECT_EQ(results.callbacks[1].node, "/second");
}

TEST(ObjectIdentity, TellsANewIntraProcessSubscriptionFromARepeatedOne) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 2, "node", "/"});
  for (const std::uint8_t identity : {1, 2}) {
    feed(ros2::RmwSubscriptionInit{3, {{identity}, 16}})(
        ros2::RclSubscriptionInit{4, 1, 3, identity == 1 ? "/first" : "/second", 1});
    feed(ros2::RclcppSubscriptionCallbackAdded{5, 0xa})(ros2::RclcppCallbackRegister{0xa, "f"});
    feed(ros2::RclcppSubscriptionInit{4, 5});
    feed(ros2::CallbackStart{0xa, true})(ros2::CallbackEnd{0xa});
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 2u);
  EXPECT_EQ(results.callbacks[0].owner_name, "/first");
  EXPECT_EQ(results.callbacks[1].owner_name, "/second");
}

}  // namespace
}  // namespace tracing
