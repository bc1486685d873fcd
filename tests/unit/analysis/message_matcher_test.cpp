// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/message_matcher.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

constexpr ObjectId kTopic = 0;
constexpr ObjectId kOtherTopic = 1;
constexpr ObjectId kSubscription = 7;

Publication published(ObjectId topic, std::int64_t time_ns) {
  return {.topic = topic, .publisher = 3, .published_ns = time_ns};
}

TEST(MessageMatcher, MeasuresFromPublicationToCallback) {
  MessageMatcher matcher;
  matcher.publish(published(kTopic, 1000), 555);
  matcher.deliver(matcher.take(kSubscription, kTopic, 555, 1050), 1150);
  matcher.finish();
  const TopicRecord& record = matcher.records()[kTopic];
  EXPECT_EQ(record.latency.summary().count, 1u);
  EXPECT_EQ(record.latency.summary().max_ns, 150);
  EXPECT_EQ(record.published_only, 0u);
  EXPECT_EQ(record.received_only, 0u);
}

TEST(MessageMatcher, CountsEverySubscriptionOfOnePublication) {
  MessageMatcher matcher;
  matcher.publish(published(kTopic, 1000), 555);
  matcher.deliver(matcher.take(kSubscription, kTopic, 555, 1050), 1100);
  matcher.deliver(matcher.take(kSubscription + 1, kTopic, 555, 1050), 1300);
  matcher.finish();
  const TopicRecord& record = matcher.records()[kTopic];
  EXPECT_EQ(record.published, 1u);
  EXPECT_EQ(record.received, 2u);
  EXPECT_EQ(record.latency.summary().count, 2u);
}

TEST(MessageMatcher, KeepsTopicsWithEqualTimestampsApart) {
  MessageMatcher matcher;
  matcher.publish(published(kTopic, 1000), 555);
  EXPECT_FALSE(matcher.take(kSubscription, kOtherTopic, 555, 1050).publication_is_known());
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].published_only, 1u);
  EXPECT_EQ(matcher.records()[kOtherTopic].received_only, 1u);
}

TEST(MessageMatcher, CountsButDoesNotFollowAPublicationWithoutTimestamp) {
  MessageMatcher matcher;
  matcher.publish(published(kTopic, 1000), 0);
  EXPECT_FALSE(matcher.take(kSubscription, kTopic, 0, 1050).publication_is_known());
  matcher.finish();
  const TopicRecord& record = matcher.records()[kTopic];
  EXPECT_EQ(record.published, 1u);
  EXPECT_EQ(record.untimed, 1u);
  EXPECT_EQ(record.untimed_taken, 1u);
  EXPECT_EQ(record.published_only + record.received_only, 0u) << "it is unknown who took the message";
}

TEST(MessageMatcher, ForgetsAPublicationAfterManyNewerOnes) {
  MessageMatcher matcher;
  const std::int64_t many = MessageMatcher::kRemembered;
  for (std::int64_t i = 1; i <= 2 * many; ++i) {
    matcher.publish(published(kTopic, i), i);
  }
  EXPECT_FALSE(matcher.take(kSubscription, kTopic, many, 1050).publication_is_known());
  EXPECT_TRUE(matcher.take(kSubscription, kTopic, many + 1, 1050).publication_is_known());
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].published, static_cast<std::uint64_t>(2 * many));
  EXPECT_EQ(matcher.records()[kTopic].published_only, static_cast<std::uint64_t>(2 * many - 1));
}

}  // namespace
}  // namespace tracing
