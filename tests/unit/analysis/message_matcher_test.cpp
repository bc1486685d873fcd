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

TEST(MessageMatcher, SaysThatAMessageWithoutSourceTimestampCannotBeFound) {
  MessageMatcher matcher;
  matcher.publish(published(kTopic, 1000), 0);
  const TakenMessage taken = matcher.take(kSubscription, kTopic, 0, 1050);
  EXPECT_FALSE(taken.publication_is_known());
  EXPECT_TRUE(taken.is_unidentified);
  matcher.finish();
  const TopicRecord& record = matcher.records()[kTopic];
  EXPECT_EQ(record.published, 1u);
  EXPECT_EQ(record.undecided, 1u);
  EXPECT_EQ(record.unidentified, 1u);
  EXPECT_EQ(record.published_only + record.received_only, 0u) << "it is unknown who took the message";
}

Publication numbered(std::uint64_t number, ObjectId publisher, std::int64_t time_ns) {
  return {.number = number, .topic = kTopic, .publisher = publisher, .published_ns = time_ns};
}

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(MessageMatcher, EstimatesThePublicationOfAMessageWithoutTimestamp) {
  MessageMatcher matcher;
  for (std::int64_t i = 1; i <= 3; ++i) {
    const Publication publication = numbered(static_cast<std::uint64_t>(i), 3, i * kSecond);
    matcher.publish(publication, 0);
    matcher.close(publication, i * kSecond + 50'000);
  }
  const TakenMessage second = matcher.take(kSubscription, kTopic, 2 * kSecond + 5'000, 4 * kSecond);
  EXPECT_EQ(second.publication.number, 2u);
  EXPECT_TRUE(second.is_estimated);
  const TakenMessage again = matcher.take(kSubscription + 1, kTopic, 2 * kSecond + 5'000, 4 * kSecond);
  EXPECT_EQ(again.publication.number, 2u) << "another subscription";
  EXPECT_TRUE(again.is_estimated);
  EXPECT_TRUE(matcher.take(kSubscription, kTopic, kSecond / 2, 4 * kSecond).is_unidentified) << "older than all";
  EXPECT_TRUE(matcher.take(kSubscription + 1, kTopic, kSecond / 2, 4 * kSecond).is_unidentified);
  matcher.finish();
  const TopicRecord& record = matcher.records()[kTopic];
  EXPECT_EQ(record.received, 4u);
  EXPECT_EQ(record.estimated, 2u);
  EXPECT_EQ(record.unidentified, 2u);
  EXPECT_EQ(record.undecided, 1u) << "one message that two subscriptions took may be any of two";
  EXPECT_EQ(record.published_only, 1u) << "so one of them was not taken";
}

TEST(MessageMatcher, SaysOfNoPublicationThatItWasNotTakenIfTakesAreNotRecorded) {
  MessageMatcher matcher;
  matcher.publish(numbered(1, 3, kSecond), 0);
  matcher.deliver_unrecorded(kTopic);
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].undecided, 1u);
  EXPECT_EQ(matcher.records()[kTopic].unrecorded, 1u);
  EXPECT_EQ(matcher.records()[kTopic].published_only, 0u);

  MessageMatcher with_recorder;
  with_recorder.publish(numbered(1, 3, kSecond), 0);
  with_recorder.finish([](ObjectId, const MessageMatcher::Takers& takers) { return takers.empty(); });
  EXPECT_EQ(with_recorder.records()[kTopic].undecided, 1u);
}

TEST(MessageMatcher, FollowsAPublicationByItsTimestampOnceTheMiddlewareHasWrittenIt) {
  MessageMatcher matcher;
  matcher.publish(numbered(1, 3, 1000), 0);
  matcher.write(kTopic, 1, 555, 1010);
  const TakenMessage taken = matcher.take(kSubscription, kTopic, 555, 1100);
  EXPECT_EQ(taken.publication.number, 1u);
  EXPECT_EQ(taken.publication.written_ns, 1010);
  EXPECT_FALSE(taken.is_estimated);
  matcher.finish();
  EXPECT_EQ(matcher.records()[kTopic].published, 1u);
  EXPECT_EQ(matcher.records()[kTopic].undecided, 0u);
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
