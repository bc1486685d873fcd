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

Publication numbered(std::uint64_t number, ObjectId publisher, std::int64_t time_ns) {
  return {.number = number, .topic = kTopic, .publisher = publisher, .published_ns = time_ns};
}

TEST(MessageMatcher, FindsAPublicationWithoutTimestampByTheTimeAtWhichItWasWritten) {
  MessageMatcher matcher;
  matcher.publish(numbered(1, 3, 1000), 0);
  matcher.publish(numbered(2, 4, 2000), 0);
  matcher.publish(numbered(3, 3, 3000), 0);
  const TakenMessage second = matcher.take(kSubscription, kTopic, 2010, 3100);
  EXPECT_EQ(second.publication.number, 2u);
  EXPECT_TRUE(second.is_by_order);
  EXPECT_EQ(matcher.take(kSubscription, kTopic, 3010, 3200).publication.number, 3u);
  EXPECT_EQ(matcher.take(kSubscription + 1, kTopic, 1010, 3300).publication.number, 1u);
  EXPECT_FALSE(matcher.take(kSubscription, kTopic, 900, 3400).publication_is_known()) << "older than all";
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].by_order, 3u);
  EXPECT_EQ(matcher.records()[kTopic].untimed_taken, 1u);
}

TEST(MessageMatcher, GivesASubscriptionNoPublicationTwiceOrOutOfOrder) {
  MessageMatcher matcher;
  matcher.publish(numbered(1, 3, 1000), 0);
  matcher.publish(numbered(2, 3, 2000), 0);
  EXPECT_EQ(matcher.take(kSubscription, kTopic, 2010, 2100).publication.number, 2u);
  EXPECT_FALSE(matcher.take(kSubscription, kTopic, 2020, 2200).publication_is_known());
  EXPECT_FALSE(matcher.take(kSubscription, kTopic, 1010, 2300).publication_is_known());
}

TEST(MessageMatcher, FollowsAPublicationByItsTimestampOnceTheMiddlewareHasWrittenIt) {
  MessageMatcher matcher;
  matcher.publish(numbered(1, 3, 1000), 0);
  matcher.write(kTopic, 1, 555, 1010);
  const TakenMessage taken = matcher.take(kSubscription, kTopic, 555, 1100);
  EXPECT_EQ(taken.publication.number, 1u);
  EXPECT_EQ(taken.publication.written_ns, 1010);
  EXPECT_FALSE(taken.is_by_order);
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].published, 1u);
  EXPECT_EQ(matcher.records()[kTopic].untimed, 0u);
}

TEST(MessageMatcher, KeepsWhenAPublicationWithTimestampWasWritten) {
  MessageMatcher matcher;
  matcher.publish(numbered(1, 3, 1000), 555);
  matcher.write(kTopic, 1, 555, 1010);
  EXPECT_EQ(matcher.take(kSubscription, kTopic, 555, 1100).publication.written_ns, 1010);
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
