// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/message_matcher.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

constexpr ObjectId kTopic = 0;
constexpr ObjectId kOtherTopic = 1;
constexpr ObjectId kSubscription = 7;

TEST(MessageMatcher, MeasuresFromPublicationToCallback) {
  MessageMatcher matcher;
  matcher.publish(kTopic, 555, 1000);
  matcher.deliver(matcher.take(kSubscription, kTopic, 555), 1150);
  matcher.finish();
  const TopicRecord& record = matcher.records()[kTopic];
  EXPECT_EQ(record.latency.summary().count, 1u);
  EXPECT_EQ(record.latency.summary().max_ns, 150);
  EXPECT_EQ(record.published_only, 0u);
  EXPECT_EQ(record.received_only, 0u);
}

TEST(MessageMatcher, CountsEverySubscriptionOfOnePublication) {
  MessageMatcher matcher;
  matcher.publish(kTopic, 555, 1000);
  matcher.deliver(matcher.take(kSubscription, kTopic, 555), 1100);
  matcher.deliver(matcher.take(kSubscription + 1, kTopic, 555), 1300);
  matcher.finish();
  const TopicRecord& record = matcher.records()[kTopic];
  EXPECT_EQ(record.published, 1u);
  EXPECT_EQ(record.received, 2u);
  EXPECT_EQ(record.latency.summary().count, 2u);
}

TEST(MessageMatcher, KeepsTopicsWithEqualTimestampsApart) {
  MessageMatcher matcher;
  matcher.publish(kTopic, 555, 1000);
  EXPECT_FALSE(matcher.take(kSubscription, kOtherTopic, 555).published_ns.has_value());
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].published_only, 1u);
  EXPECT_EQ(matcher.records()[kOtherTopic].received_only, 1u);
}

TEST(MessageMatcher, CountsButDoesNotFollowAPublicationWithoutTimestamp) {
  MessageMatcher matcher;
  matcher.publish(kTopic, 0, 1000);
  EXPECT_FALSE(matcher.take(kSubscription, kTopic, 0).published_ns.has_value());
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].published, 1u);
  EXPECT_EQ(matcher.records()[kTopic].published_only, 1u);
}

TEST(MessageMatcher, ForgetsAPublicationAfterManyNewerOnes) {
  MessageMatcher matcher;
  const std::int64_t many = MessageMatcher::kRemembered;
  for (std::int64_t i = 1; i <= 2 * many; ++i) matcher.publish(kTopic, i, i);
  EXPECT_FALSE(matcher.take(kSubscription, kTopic, many).published_ns.has_value());
  EXPECT_TRUE(matcher.take(kSubscription, kTopic, many + 1).published_ns.has_value());
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].published, static_cast<std::uint64_t>(2 * many));
  EXPECT_EQ(matcher.records()[kTopic].published_only, static_cast<std::uint64_t>(2 * many - 1));
}

}  // namespace
}  // namespace tracing
