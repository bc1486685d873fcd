// SPDX-License-Identifier: Apache-2.0
// Conditions on what nodes do, decided from traces whose times are known.
#include "tests/unit/live/recorded_launch.hpp"

namespace tracing {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Kind = LiveCondition::Kind;
using Subject = LiveCondition::Subject;

using LiveConditionsTest = RecordedLaunch;

const LiveCondition kSilentTopic{.name = "/chatter", .window = 1s};
const LiveCondition kSilentNode{.subject = Subject::kNode, .name = "/talker", .window = 1s};

LiveCondition rate(std::optional<double> below, std::optional<double> above) {
  return {.kind = LiveCondition::Kind::kRate, .name = "/chatter", .window = 2s, .below = below, .above = above};
}

TEST_F(LiveConditionsTest, SilenceHoldsWhenNothingHasHappenedForItsTime) {
  conditions_.watch(1, kSilentTopic);
  conditions_.watch(2, kSilentNode);
  make(0);
  publish_each(100, 100, 500);
  EXPECT_THAT(told_until(1499), IsEmpty());
  conditions_.advance(kBegin + 1500 * kMs);
  EXPECT_THAT(told_, ElementsAre("1 holds 1.000 talker-1", "2 holds 1.000 talker-1"));
  conditions_.advance(kBegin + 9000 * kMs);
  EXPECT_EQ(told_.size(), 2U);
}

TEST_F(LiveConditionsTest, SilenceIsOverWithTheNextMessageAndMayComeAgain) {
  conditions_.watch(1, kSilentTopic);
  make(0);
  publish(100);
  publish(1600);
  publish(1700);
  EXPECT_THAT(told_until(2800),
              ElementsAre("1 holds 1.500 talker-1", "1 is over 1.500 talker-1", "1 holds 1.100 talker-1"));
}

TEST_F(LiveConditionsTest, SilenceCountsFromTheFirstTimeThatTheNameWasSeen) {
  conditions_.watch(1, kSilentTopic);
  conditions_.advance(kBegin);
  make(5000);
  EXPECT_THAT(told_until(5999), IsEmpty());
  conditions_.advance(kBegin + 6000 * kMs);
  EXPECT_THAT(told_, ElementsAre("1 holds 1.000 talker-1"));
}

TEST_F(LiveConditionsTest, OthersThanTheLaunchDoNotCount) {
  conditions_.watch(1, kSilentTopic);
  make(0);
  make(10, kStranger);
  publish(500);
  publish(1400, kStranger);
  EXPECT_THAT(told_until(1500), ElementsAre("1 holds 1.000 talker-1"));
}

TEST_F(LiveConditionsTest, ANodeThatHasEndedDoesNotHangButItsTopicIsSilent) {
  conditions_.watch(1, kSilentTopic);
  conditions_.watch(2, kSilentNode);
  make(0);
  publish(500);
  launch_.ended = {kTalker.vpid};
  EXPECT_THAT(told_until(2000), ElementsAre("1 holds 1.500 talker-1"));
}

// Whoever waits for a visit after a cool_down must not get one for it.
TEST_F(LiveConditionsTest, TheSilenceOfANodeIsOverWhenItsProcessEnds) {
  conditions_.watch(2, kSilentNode);
  make(0);
  publish(500);
  EXPECT_THAT(told_until(2000), ElementsAre("2 holds 1.500 talker-1"));
  launch_.ended = {kTalker.vpid};
  conditions_.advance(kBegin + 2500 * kMs);
  conditions_.advance(kBegin + 9000 * kMs);
  EXPECT_THAT(told_, ElementsAre("2 holds 1.500 talker-1", "2 is over 2.000 talker-1"));
}

// With subscriptions in its process and in others.
TEST_F(LiveConditionsTest, AMessageThatGoesBothWaysCountsOnce) {
  conditions_.watch(1, rate(std::nullopt, 15));
  conditions_.watch(2, rate(8, std::nullopt));
  make(0);
  for (std::int64_t time = 100; time <= 5000; time += 100) {
    write(time, kTalker, ros2::RclcppIntraPublish{0x21, 0x40});
    publish(time);
  }
  EXPECT_THAT(told_until(5000), IsEmpty());
}

TEST_F(LiveConditionsTest, TheNextProcessOfTheNameBeginsAnew) {
  conditions_.watch(1, kSilentTopic);
  conditions_.watch(2, kSilentNode);
  constexpr testing::Thread kNext{102, 102, "talker"};
  make(0);
  publish(500);
  launch_.ended = {kTalker.vpid};
  make(2000, kNext);
  EXPECT_THAT(told_until(2999), ElementsAre("1 holds 1.500 talker-1", "1 is over 1.500 talker-2"));
  told_.clear();
  conditions_.advance(kBegin + 3000 * kMs);
  EXPECT_THAT(told_, ElementsAre("1 holds 1.000 talker-2", "2 holds 1.000 talker-2"));
}

TEST_F(LiveConditionsTest, WhatWasLostMayHaveBeenAMessage) {
  conditions_.watch(1, kSilentTopic);
  make(0);
  publish(500);
  writer_.end_packet(0);
  write(1200, kTalker, ros2::RclNodeInit{0x99, 0x98, "other", "/"});
  writer_.discard_events(0, 3);
  write(1300, kTalker, ros2::RclNodeInit{0x97, 0x96, "another", "/"});
  EXPECT_THAT(told_until(2200), IsEmpty());
  conditions_.advance(kBegin + 2400 * kMs);
  EXPECT_EQ(told_.size(), 1U);
}

TEST_F(LiveConditionsTest, ARateIsBelowItsLimitWhenMoreThanOneMessageIsMissing) {
  conditions_.watch(1, rate(10, std::nullopt));
  make(0);
  publish_each(100, 100, 6000);    // 10 Hz, at which windows have 19 to 21
  publish_each(125, 6125, 10000);  // 8 Hz
  publish_each(100, 10100, 15000);
  EXPECT_THAT(told_until(15000),
              ElementsAre(::testing::StartsWith("1 holds 9.000"), ::testing::StartsWith("1 is over")));
}

TEST_F(LiveConditionsTest, ARateIsBelowItsLimitWhenNothingComes) {
  conditions_.watch(1, rate(10, std::nullopt));
  conditions_.watch(2, rate(1, std::nullopt));
  make(0);
  EXPECT_THAT(told_until(1999), IsEmpty());
  conditions_.advance(kBegin + 2100 * kMs);
  EXPECT_THAT(told_, ElementsAre("1 holds 0.000 talker-1", "2 holds 0.000 talker-1"));
}

TEST_F(LiveConditionsTest, ARateIsAboveItsLimitWithMoreThanOneMessageTooMany) {
  conditions_.watch(1, rate(std::nullopt, 10));
  make(0);
  publish_each(100, 100, 6000);
  publish_each(50, 6050, 9000);
  EXPECT_THAT(told_until(9000), ElementsAre("1 holds 11.000 talker-1"));
}

TEST_F(LiveConditionsTest, ANameThatNothingHasIsToldOnceAfterTheGrace) {
  conditions_.watch(1, {.name = "/chater", .window = 1s, .grace = 10s});
  conditions_.watch(2, {.subject = Subject::kNode, .name = "/taker", .window = 1s, .grace = 20s});
  conditions_.watch(3, kSilentTopic);
  make(0);
  make(0, kStranger);
  told_until(10);
  conditions_.tell_unseen(100s);
  conditions_.tell_unseen(109s);
  EXPECT_THAT(told_, IsEmpty());
  conditions_.tell_unseen(110s);
  conditions_.tell_unseen(111s);
  EXPECT_THAT(told_, ElementsAre("1 unseen, there is /chatter"));
  conditions_.tell_unseen(120s);
  EXPECT_THAT(told_, ElementsAre("1 unseen, there is /chatter", "2 unseen, there is /talker"));
}

TEST_F(LiveConditionsTest, WhatIsForgottenIsNotToldAndWhatIsWatchedLateCountsFromThenOn) {
  conditions_.watch(1, kSilentTopic);
  make(0);
  publish(500);
  told_until(1000);
  conditions_.forget(1);
  conditions_.watch(2, kSilentNode);
  conditions_.advance(kBegin + 1999 * kMs);
  EXPECT_THAT(told_, IsEmpty());
  conditions_.advance(kBegin + 2000 * kMs);
  EXPECT_THAT(told_, ElementsAre("2 holds 1.000 talker-1"));
}

}  // namespace
}  // namespace tracing
