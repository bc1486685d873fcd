// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/join/message_join.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

// Thread 71 publishes /topic (rmw 1, rcl 11), thread 72 subscribes (rmw 2, rcl 12, callback 0xcb).
struct MessageJoinTest : ::testing::Test, ExecutionSink {
  MessageJoinTest() {
    const Origin begin{};
    model.on(begin, ros2::RmwPublisherInit{1, {}});
    model.on(begin, ros2::RclPublisherInit{11, 0, 1, "/topic", 1});
    model.on(begin, ros2::RmwSubscriptionInit{2, {}});
    model.on(begin, ros2::RclSubscriptionInit{12, 0, 2, "/topic", 1});
    model.on(begin, ros2::RclcppSubscriptionInit{12, 22});
    model.on(begin, ros2::RclcppSubscriptionCallbackAdded{22, 0xcb});
    model.on(begin, ros2::RmwPublisherInit{3, {}});  // the middleware's own
    callback = model.callback(0, 0xcb);
    other_callback = model.client_callback(0, 0xdd);
  }
  void on_publication(const Publication& publication) override { publications.push_back(publication); }
  void on_message(const MessageFlow& message) override { messages.push_back(message); }
  void on_message_link(const MessageLink& link) override { links.push_back(link); }

  ObjectModel model;
  std::vector<Publication> publications;
  std::vector<MessageFlow> messages;
  std::vector<MessageLink> links;
  ExecutorWaits waits;
  MessageJoin join{model, waits, *this};
  ThreadState publishing;
  ThreadState taking;
  ObjectId callback = kNoObject;
  ObjectId other_callback = kNoObject;
};

TEST_F(MessageJoinTest, JoinsThePublishFunctionsOfAThread) {
  join.on({100, 0, 71}, publishing, ros2::RclcppPublish{9});
  join.on({110, 0, 71}, publishing, ros2::RclPublish{11, 9});
  join.on({120, 0, 71}, publishing, ros2::RmwPublish{1, 9, 777});
  join.on({130, 0, 71}, publishing, ros2::RmwPublish{1, 9, 778});
  ASSERT_EQ(publications.size(), 2u);
  EXPECT_EQ(publications[0].number, 1u);
  EXPECT_EQ(publications[0].rclcpp_ns, 100);
  EXPECT_EQ(publications[0].rcl_ns, 110);
  EXPECT_EQ(publications[0].published_ns, 120);
  EXPECT_EQ(publications[1].rclcpp_ns, 0) << "another message at the same address";
  EXPECT_EQ(publications[1].rcl_ns, 0);
}

TEST_F(MessageJoinTest, GivesATakenMessageToTheNextCallbackOfTheThread) {
  join.on({120, 0, 71}, publishing, ros2::RmwPublish{1, 9, 777});
  waits.wait({50, 0, 72}, taking.waits);
  waits.look({140, 0, 72}, taking.waits);
  join.on({150, 0, 72}, taking, ros2::RmwTake{2, 8, 777, true});
  join.on_callback({170, 0, 72}, taking, callback, false);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].publication.number, 1u);
  EXPECT_EQ(messages[0].taken_ns, 150);
  EXPECT_EQ(messages[0].executor_waited_ns, 20);
  EXPECT_EQ(messages[0].callback, callback);
  EXPECT_EQ(messages[0].callback_begin_ns, 170);
  EXPECT_EQ(join.through_middleware().records()[0].latency.summary().max_ns, 50);
}

TEST_F(MessageJoinTest, GivesATakenMessageToNoCallbackOfAnotherObject) {
  join.on({150, 0, 72}, taking, ros2::RmwTake{2, 8, 777, true});
  join.on_callback({170, 0, 72}, taking, other_callback, false);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].callback, kNoObject);
  EXPECT_EQ(messages[0].publication.number, 0u) << "it is not in the trace";
  EXPECT_EQ(messages[0].callback_begin_ns, 0);
}

TEST_F(MessageJoinTest, FollowsAMessageThroughARingBuffer) {
  join.on({1, 0, 72}, ros2::RclcppConstructRingBuffer{5, 10});
  join.on({2, 0, 72}, ros2::RclcppBufferToIpb{5, 6});
  join.on({3, 0, 72}, ros2::RclcppIpbToSubscription{6, 22});
  join.on({100, 0, 71}, publishing, ros2::RclcppIntraPublish{11, 9});
  join.on({110, 0, 71}, publishing, ros2::RclcppRingBufferEnqueue{5, 0, 1, false});
  join.on({120, 0, 72}, taking, ros2::RclcppRingBufferDequeue{5, 0, 0});
  join.on_callback({130, 0, 72}, taking, callback, true);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_TRUE(messages[0].publication.intra_process);
  EXPECT_EQ(messages[0].publication.published_ns, 100);
  EXPECT_EQ(messages[0].taken_ns, 120);
  EXPECT_EQ(messages[0].callback, callback);
}

TEST_F(MessageJoinTest, TellsWhatIsGivenToNone) {
  join.on({150, 0, 72}, taking, ros2::RmwTake{2, 8, 777, true});
  join.give_to_none({160, 0, 72}, taking);
  join.give_to_none({170, 0, 72}, taking);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].callback, kNoObject);
}

TEST_F(MessageJoinTest, CountsInternalAndUnknownMessages) {
  join.on({100, 0, 71}, publishing, ros2::RmwPublish{3, 9, 777});
  join.on({110, 0, 71}, publishing, ros2::RmwPublish{4, 9, 778});
  join.on({120, 0, 72}, taking, ros2::RmwTake{4, 9, 778, true});
  EXPECT_TRUE(publications.empty());
  EXPECT_EQ(join.counts().internal, 1u);
  EXPECT_EQ(join.counts().unknown, 2u);
  EXPECT_EQ(join.counts().unknown_publications, 1u);
}

// As rmw_cyclonedds does for ros_discovery_info.
TEST_F(MessageJoinTest, CountsWhatMiddlewareDoesForItselfWithoutTellingOfTheEndpoint) {
  join.on({90, 0, 71}, ros2::RclInit{1, "8.2.0"});
  join.on({95, 0, 71}, publishing, ros2::RclPublish{11, 9});
  join.on({96, 0, 71}, publishing, ros2::RmwPublish{1, 9, 776});
  join.on({97, 0, 72}, publishing, ros2::RclcppExecutorExecute{12});
  join.on({110, 0, 73}, taking, ros2::RmwPublish{4, 9, 778});
  join.on({120, 0, 73}, taking, ros2::RmwTake{5, 9, 778, true});
  EXPECT_EQ(publications.size(), 1u);
  EXPECT_EQ(join.counts().internal, 2u);
  EXPECT_EQ(join.counts().unknown, 0u);
  join.on({130, 0, 71}, publishing, ros2::RclPublish{14, 10});
  join.on({131, 0, 71}, publishing, ros2::RmwPublish{6, 10, 779});
  EXPECT_EQ(join.counts().unknown_in_whole, 1u) << "the program has published that";
}

TEST_F(MessageJoinTest, TellsTheLinksBetweenObjectsOfTheTrace) {
  join.on({100, 0, 71}, ros2::MessageLinkPartialSync{{12, 99}, {11}});
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].subscriptions, std::vector<ObjectId>{0});
  EXPECT_EQ(links[0].publishers, std::vector<ObjectId>{0});
}

}  // namespace
}  // namespace tracing
