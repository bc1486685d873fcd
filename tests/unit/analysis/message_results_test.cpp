// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/analysis/summary_objects.hpp"

namespace tracing {
namespace {

class MessageResults : public testing::SummaryObjects {
 protected:
  void publish(std::uint64_t number, std::int64_t time_ns) {
    const Publication publication{.number = number, .topic = 0, .publisher = 0, .published_ns = time_ns};
    messages.publish(publication, time_ns);
    deliveries.on_publication(publication);
  }
  MessageMatcher messages;
  DeliveryStatistics deliveries{model};
  IntraProcessMatcher buffers{model};
};

TEST_F(MessageResults, OfATopicHaveTheRateOfItsPublishers) {
  publish(1, 1'000'000'000);
  publish(2, 1'500'000'000);
  publish(3, 2'000'000'000);
  messages.finish();
  deliveries.finish();
  const std::vector<TopicResult> topics = topic_results(subjects, messages, deliveries);
  ASSERT_EQ(topics.size(), 1u);
  EXPECT_EQ(topics[0].name, "/topic");
  EXPECT_EQ(topics[0].publishers, 1u);
  EXPECT_EQ(topics[0].subscriptions, 1u);
  EXPECT_EQ(topics[0].published, 3u);
  EXPECT_EQ(topics[0].published_only, 3u);
  EXPECT_DOUBLE_EQ(topics[0].rate_hz, 2);
  EXPECT_EQ(topics[0].interval.count, 2u);
  EXPECT_TRUE(topics[0].doubtful) << "its process lost events";
}

TEST_F(MessageResults, OfASubscriptionAreThereWhenItGotMessages) {
  EXPECT_TRUE(subscription_results(subjects, deliveries, buffers).empty());
  publish(1, 1'000);
  deliveries.on_message({.publication = {.number = 1, .topic = 0, .publisher = 0, .published_ns = 1'000},
                         .subscription = 0,
                         .taken_ns = 1'100,
                         .callback = 0,
                         .callback_begin_ns = 1'150});
  deliveries.finish();
  const std::vector<SubscriptionResult> subscriptions = subscription_results(subjects, deliveries, buffers);
  ASSERT_EQ(subscriptions.size(), 1u);
  EXPECT_EQ(subscriptions[0].process, 0u);
  EXPECT_EQ(subscriptions[0].node, "/node");
  EXPECT_EQ(subscriptions[0].topic, "/topic");
  EXPECT_EQ(subscriptions[0].queue_depth, 5u);
  EXPECT_EQ(subscriptions[0].received, 1u);
  EXPECT_EQ(subscriptions[0].delivered, 1u);
  EXPECT_EQ(subscriptions[0].latency.max_ns, 150);
  EXPECT_TRUE(subscriptions[0].doubtful);
}

TEST_F(MessageResults, CountWhatIsOverwrittenInTheBufferOfASubscription) {
  const Origin origin{0, 1, 1};
  buffers.on(origin, ros2::RclcppConstructRingBuffer{5, 1});
  buffers.on(origin, ros2::RclcppBufferToIpb{5, 6});
  buffers.on(origin, ros2::RclcppIpbToSubscription{6, 22});
  buffers.enqueue(origin, ros2::RclcppRingBufferEnqueue{5, 0, 1, true}, std::nullopt);
  EXPECT_EQ(buffers.overwritten(), (std::map<ObjectId, std::uint64_t>{{0, 1}}));
}

}  // namespace
}  // namespace tracing
