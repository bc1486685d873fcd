// SPDX-License-Identifier: Apache-2.0
// What nodes of ROS 2 Humble and Iron record: rmw_publish has the message alone. Humble records nothing of what goes on
// within a process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;
using testing::topic;

constexpr std::int64_t kMs = 1'000'000;

// Process 71 has node /talker with a publisher of /topic (rcl 11) and the middleware's own publisher; process 72 has
// node /listener with a subscription (rmw 2, rcl 12, callback 0xcb).
class OlderRecordings : public ::testing::Test {
 protected:
  OlderRecordings() {
    feed.in(71, 71)(ros2::RclInit{1, "6.3.2"})(ros2::RmwPublisherInit{8, {}});
    feed(ros2::RmwPublish{0, 77, 0});  // of the graph, before the node
    feed(ros2::RclNodeInit{1, 0, "talker", "/"})(ros2::RmwPublisherInit{1, {}});
    feed(ros2::RclPublisherInit{11, 1, 1, "/topic", 10});
    feed.in(72, 72)(ros2::RclInit{1, "6.3.2"})(ros2::RclNodeInit{1, 0, "listener", "/"});
    feed(ros2::RmwSubscriptionInit{2, {}})(ros2::RclSubscriptionInit{12, 1, 2, "/topic", 10});
    feed(ros2::RclcppSubscriptionInit{12, 22})(ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
  }
  // The source timestamp of the message is 5 us later.
  void publish(std::int64_t time_ns) {
    feed.in(71, 71).at(time_ns)(ros2::RclcppPublish{9})(ros2::RclPublish{11, 9})(ros2::RmwPublish{0, 9, 0});
    feed.at(time_ns + 30'000)(ros2::RclcppExecutorWaitForWork{-1});
  }
  void receive(std::int64_t time_ns, std::int64_t published_ns) {
    feed.in(72, 72).at(time_ns)(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorExecute{12});
    feed(ros2::RmwTake{2, 9, published_ns + 5'000, true})(ros2::CallbackStart{0xcb, false})(ros2::CallbackEnd{0xcb});
  }
  static std::uint64_t unmatched(const Ros2Results& results, const std::string& event) {
    std::uint64_t count = 0;
    for (const UnmatchedResult& result : results.unmatched) {
      count += result.event == event ? result.count : 0;
    }
    return count;
  }
  Feed feed;
};

TEST_F(OlderRecordings, FollowEachMessageAndFindWhatGotLost) {
  for (std::int64_t i = 1; i <= 10; ++i) {
    publish(i * 10 * kMs);
    if (i != 4 && i != 5) {
      receive(i * 10 * kMs + kMs, i * 10 * kMs);
    }
  }
  const Ros2Results results = feed.results();
  const TopicResult& found = topic(results, "/topic");
  EXPECT_EQ(found.published, 10u);
  EXPECT_EQ(found.received, 8u);
  EXPECT_EQ(found.estimated, 8u);
  EXPECT_EQ(found.published_only, 2u);
  EXPECT_EQ(found.unidentified + found.undecided + found.received_only, 0u);
  EXPECT_EQ(found.latency.count, 8u);
  const SubscriptionResult& subscription = results.subscriptions.at(0);
  EXPECT_EQ(subscription.lost, 2u);
  EXPECT_EQ(subscription.estimated, 8u);
  EXPECT_EQ(subscription.latency.p50_ns, kMs + 30);
  EXPECT_EQ(results.internal_messages, 1u) << "that of the graph";
  EXPECT_EQ(results.unknown_messages, 0u);
  EXPECT_THAT(results.remarks,
              ::testing::ElementsAre(
                  "The trace has no timestamps of publications (tracetools 6.3.2); ros2_tracing records them from 8.0 "
                  "(ROS 2 Jazzy) on. Of 8 messages the publication was found by its time: results with ~ are "
                  "estimates."));
}

TEST_F(OlderRecordings, NameChainsWhoseMessagesAreEstimates) {
  feed.in(71, 71)(ros2::RclTimerInit{5, 100})(ros2::RclcppTimerCallbackAdded{5, 0xaa})(ros2::RclcppTimerLinkNode{5, 1});
  for (std::int64_t i = 1; i <= 3; ++i) {
    feed.in(71, 71).at(i * 10 * kMs - 100)(ros2::CallbackStart{0xaa, false});
    feed.at(i * 10 * kMs)(ros2::RclPublish{11, 9})(ros2::RmwPublish{0, 9, 0});
    feed.at(i * 10 * kMs + 30'000)(ros2::CallbackEnd{0xaa});
    receive(i * 10 * kMs + kMs, i * 10 * kMs);
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.chains.size(), 1u);
  EXPECT_EQ(results.chains[0].response.count, 3u);
  EXPECT_TRUE(results.chains[0].estimated);
}

TEST_F(OlderRecordings, CountNoLossWhereAMessageCanNotBeIdentified) {
  // Another publisher of the topic, of a process whose threads publish at the same time.
  feed.in(73, 73)(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{11, 0, 1, "/topic", 10});
  for (std::int64_t i = 1; i <= 6; ++i) {
    publish(i * 10 * kMs);
    if (i == 3) {
      feed.in(73, 73).at(i * 10 * kMs)(ros2::RclPublish{11, 9})(ros2::RmwPublish{0, 9, 0});
      feed.at(i * 10 * kMs + 30'000)(ros2::RclcppExecutorWaitForWork{-1});
    }
    receive(i * 10 * kMs + kMs, i * 10 * kMs);
  }
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").estimated, 5u);
  EXPECT_EQ(topic(results, "/topic").unidentified, 1u);
  EXPECT_EQ(topic(results, "/topic").undecided, 1u) << "one of two";
  EXPECT_EQ(topic(results, "/topic").published_only, 1u) << "the other one";
  EXPECT_EQ(results.subscriptions.at(0).dropped(), 0u);
  EXPECT_EQ(results.subscriptions.at(0).delivered, 6u);
}

TEST_F(OlderRecordings, HaveNoLossAtTheBeginOfALateSession) {
  receive(5 * kMs, 4 * kMs);  // published before the session
  publish(10 * kMs);
  receive(11 * kMs, 10 * kMs);
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").received, 2u);
  EXPECT_EQ(topic(results, "/topic").estimated, 1u);
  EXPECT_EQ(topic(results, "/topic").published_only, 0u);
  EXPECT_EQ(results.subscriptions.at(0).dropped(), 0u);
}

TEST_F(OlderRecordings, SayWhichPublishersCameLate) {
  feed.in(74, 74).at(kMs)(ros2::RclPublish{55, 9})(ros2::RmwPublish{0, 9, 0});  // nothing is known of it
  feed.in(71, 71).at(2 * kMs)(ros2::RclPublish{55, 9})(ros2::RmwPublish{0, 9, 0});
  const Ros2Results results = feed.results();
  EXPECT_EQ(results.unknown_messages, 2u);
  EXPECT_EQ(results.unknown_in_whole, 1u) << "the process began within the trace";
}

TEST(OlderRecordingsInPart, HaveTheLogsOfANodeWhosePublisherRclCopies) {
  Feed feed;
  feed.in(71, 71)(ros2::RclInit{1, "4.1.1"})(ros2::RmwPublisherInit{1, {}});
  feed(ros2::RclPublisherInit{0x7ffd01, 1, 1, "/rosout", 1000})(ros2::RclNodeInit{1, 0, "one", "/"});
  feed.at(kMs)(ros2::RclPublish{0x7ffd55, 9})(ros2::RmwPublish{0, 9, 0});
  feed.at(2 * kMs)(ros2::RclcppPublish{8})(ros2::RclPublish{0x7ffd55, 8})(ros2::RmwPublish{0, 8, 0});
  Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/rosout").published, 1u);
  EXPECT_EQ(results.unknown_messages, 1u) << "rclcpp publishes no logs";
}

TEST(OlderRecordingsInPart, SayThatTheLogsOfSeveralNodesAreNotTold) {
  Feed feed;
  feed.in(71, 71)(ros2::RclInit{1, "4.1.1"});
  for (const ros2::Handle node : {1, 2}) {
    feed(ros2::RmwPublisherInit{node, {}})(ros2::RclPublisherInit{0x7ffd01, node, node, "/rosout", 1000});
    feed(ros2::RclNodeInit{node, 0, node == 1 ? "one" : "two", "/"});
  }
  feed.at(kMs)(ros2::RclPublish{0x7ffd55, 9})(ros2::RmwPublish{0, 9, 0});
  const Ros2Results results = feed.results();
  EXPECT_EQ(results.unknown_messages, 0u);
  EXPECT_THAT(results.remarks,
              ::testing::ElementsAre("1 message of a process with several nodes went to /rosout (tracetools 4.1.1): "
                                     "before 8.0, ros2_tracing does not tell which of the nodes has logged it, and the "
                                     "topic does not count it."));
}

TEST(OlderRecordingsInPart, SayThatCallsOfServicesAreNotTold) {
  Feed feed;
  feed.in(71, 71)(ros2::RclInit{1, "8.2.4"})(ros2::RclNodeInit{1, 0, "one", "/"});
  feed(ros2::RclServiceInit{5, 1, 6, "/add"})(ros2::RclcppServiceCallbackAdded{5, 0xaa});
  feed.at(kMs)(ros2::CallbackStart{0xaa, false}).at(2 * kMs)(ros2::CallbackEnd{0xaa});
  EXPECT_THAT(feed.results().remarks,
              ::testing::ElementsAre("Services were called, and the trace has neither requests nor responses "
                                     "(tracetools 8.2.4): ros2_tracing records them from 8.5 on. Who called, how long "
                                     "calls took, and which goals actions had is not known."));
}

TEST(OlderRecordingsInPart, DoNotBlameTheSessionForMessagesWithoutRclPublish) {
  Feed feed;
  feed(ros2::RclInit{1, "4.1.1"})(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{11, 0, 1, "/topic", 10});
  feed(ros2::RmwPublish{0, 9, 0})(ros2::RmwPublish{0, 9, 0});
  const Ros2Results results = feed.results();
  EXPECT_EQ(results.unknown_messages, 0u);
  EXPECT_EQ(results.unnamed_messages, 2u);
  EXPECT_THAT(results.remarks, ::testing::ElementsAre(
                                   "2 messages have no publisher (tracetools 4.1.1): before 8.0, ros2_tracing names it "
                                   "in rcl_publish alone, which the trace does not hold."));
}

TEST(OlderRecordingsInPart, SayThatTheMiddlewareIsNotInTheTrace) {
  Feed feed;
  feed(ros2::RclInit{1, "2.3.0"})(ros2::RclPublisherInit{11, 0, 1, "/topic", 10})(ros2::RclPublish{11, 9});
  EXPECT_THAT(
      feed.results().remarks,
      ::testing::ElementsAre("The trace has rcl_publish, and no event of the middleware (rmw_publish, rmw_take) "
                             "(tracetools 2.3.0): ros2_tracing before 3.1 has none. Which messages came, and "
                             "when, is not known."));
}

// A container: node /both publishes /topic (rcl 11), and its subscription (rmw 2, rcl 12) has an object for messages
// within the process (22, callback 0xc1) and one for the others (23, callback 0xc2).
class OlderContainer : public ::testing::Test {
 protected:
  OlderContainer() {
    feed(ros2::RclNodeInit{1, 0, "both", "/"})(ros2::RmwPublisherInit{1, {}});
    feed(ros2::RclPublisherInit{11, 1, 1, "/topic", 10})(ros2::RmwSubscriptionInit{2, {}});
    feed(ros2::RclSubscriptionInit{12, 1, 2, "/topic", 10});
    feed(ros2::RclcppSubscriptionCallbackAdded{22, 0xc1})(ros2::RclcppSubscriptionInit{12, 22});
    feed(ros2::RclcppSubscriptionInit{12, 23})(ros2::RclcppSubscriptionCallbackAdded{23, 0xc2});
  }
  // Through the middleware, for subscriptions of other processes, too.
  void publish(std::int64_t time_ns) {
    feed.at(time_ns)(ros2::RclcppPublish{9})(ros2::RclPublish{11, 9})(ros2::RmwPublish{0, 9, 0});
    feed.at(time_ns + 30'000)(ros2::RclcppExecutorWaitForWork{-1});
  }
  // rclcpp takes the copy and ignores it.
  void take_copy(std::int64_t time_ns, std::int64_t published_ns) {
    feed.at(time_ns)(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorExecute{12});
    feed(ros2::RmwTake{2, 9, published_ns + 5'000, true})(ros2::RclcppExecutorWaitForWork{-1});
  }
  Feed feed;
};

TEST_F(OlderContainer, TheCopyThroughTheMiddlewareIsNotDroppedInIron) {
  feed(ros2::RclcppConstructRingBuffer{50, 10})(ros2::RclcppBufferToIpb{50, 60})(ros2::RclcppIpbToSubscription{60, 22});
  for (std::int64_t i = 1; i <= 11; ++i) {
    const std::int64_t begin = i * 10 * kMs;
    feed.at(begin - 1'000)(ros2::RclcppIntraPublish{11, 9})(ros2::RclcppRingBufferEnqueue{50, 0, 1, false});
    publish(begin);
    feed(ros2::RclcppRingBufferDequeue{50, 0, 0})(ros2::CallbackStart{0xc1, true})(ros2::CallbackEnd{0xc1});
    take_copy(begin + kMs, begin);
  }
  const Ros2Results results = feed.results();
  const SubscriptionResult& subscription = results.subscriptions.at(0);
  EXPECT_EQ(subscription.received, 11u);
  EXPECT_EQ(subscription.delivered, 11u);
  EXPECT_EQ(subscription.dropped(), 0u);
  EXPECT_EQ(topic(results, "/topic").published_only, 0u);
}

TEST_F(OlderContainer, TheCopyThroughTheMiddlewareIsNotDroppedInHumble) {
  for (std::int64_t i = 1; i <= 11; ++i) {
    const std::int64_t begin = i * 10 * kMs;
    publish(begin);
    feed(ros2::CallbackStart{0xc1, true})(ros2::CallbackEnd{0xc1});
    take_copy(begin + kMs, begin);
  }
  const Ros2Results results = feed.results();
  EXPECT_EQ(topic(results, "/topic").unrecorded, 11u);
  for (const SubscriptionResult& subscription : results.subscriptions) {
    EXPECT_EQ(subscription.dropped(), 0u);
  }
  EXPECT_THAT(results.remarks, ::testing::Contains(::testing::HasSubstr("before 6.1 (ROS 2 Iron)")));
}

TEST_F(OlderContainer, AMessageFromElsewhereThatNoCallbackGotIsDropped) {
  feed.in(73, 73)(ros2::RmwPublisherInit{1, {}})(ros2::RclPublisherInit{11, 0, 1, "/topic", 10});
  feed.at(10 * kMs)(ros2::RclPublish{11, 9})(ros2::RmwPublish{0, 9, 0});
  feed.at(10 * kMs + 30'000)(ros2::RclcppExecutorWaitForWork{-1});
  feed.in(71, 71);
  take_copy(11 * kMs, 10 * kMs);
  EXPECT_EQ(feed.results().subscriptions.at(0).not_executed, 1u);
}

// rclcpp's lifecycle nodes copy the handles of the services that rcl_lifecycle has made.
TEST(LifecycleServices, BelongToTheirNodeThoughRclcppHasOtherHandles) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 0, "node", "/ns"});
  feed(ros2::RclServiceInit{30, 1, 40, "/ns/node/get_parameters"})(ros2::RclcppServiceCallbackAdded{30, 0xa0});
  const std::string names[] = {"change_state", "get_state", "get_available_states", "get_available_transitions",
                               "get_transition_graph"};
  ros2::Handle handle = 50;
  for (const std::string& name : names) {
    const std::string full = "/ns/node/" + name;
    feed(ros2::RclServiceInit{handle, 1, handle + 10, full});
    ++handle;
  }
  feed(ros2::RclLifecycleStateMachineInit{1, 99});
  for (ros2::Handle copy = 80; copy < 85; ++copy) {
    feed(ros2::RclcppServiceCallbackAdded{copy, copy + 100});
  }
  feed(ros2::RclcppServiceCallbackAdded{86, 186});  // of something else
  for (ros2::Handle callback = 180; callback <= 186; ++callback) {
    if (callback != 185) {
      feed(ros2::CallbackStart{callback, false})(ros2::CallbackEnd{callback});
    }
  }
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 6u);
  for (const std::string& name : names) {
    const auto of_service = [&](const CallbackResult& callback) {
      return callback.node == "/ns/node" && callback.owner_name == "/ns/node/" + name;
    };
    EXPECT_EQ(std::count_if(results.callbacks.begin(), results.callbacks.end(), of_service), 1) << name;
  }
  const auto without_node = [](const CallbackResult& callback) { return callback.node.empty(); };
  EXPECT_EQ(std::count_if(results.callbacks.begin(), results.callbacks.end(), without_node), 1);
}

TEST(LifecycleServices, AreNotGuessedIfTheyAreInAnotherOrder) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 0, "node", "/"});
  ros2::Handle handle = 50;
  for (const char* name : {"/node/get_state", "/node/change_state", "/node/get_available_states",
                           "/node/get_available_transitions", "/node/get_transition_graph"}) {
    feed(ros2::RclServiceInit{handle, 1, handle + 10, name});
    ++handle;
  }
  feed(ros2::RclLifecycleStateMachineInit{1, 99})(ros2::RclcppServiceCallbackAdded{80, 180});
  feed(ros2::CallbackStart{180, false})(ros2::CallbackEnd{180});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.callbacks.size(), 1u);
  EXPECT_EQ(results.callbacks[0].node, "");
}

}  // namespace
}  // namespace tracing
