// SPDX-License-Identifier: Apache-2.0
// Conditions on what nodes do, decided from traces whose times are known.
#include "tracing/show/live/live_conditions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <set>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/decode/reader/trace_reader.hpp"

namespace tracing {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Kind = LiveCondition::Kind;
using Subject = LiveCondition::Subject;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kBegin = 1'767'225'600'000'000'000;
constexpr testing::Thread kTalker{101, 101, "talker"};
constexpr testing::Thread kListener{103, 103, "listener"};
constexpr testing::Thread kStranger{900, 900, "talker"};

class FakeLaunch : public LaunchedProcesses {
 public:
  std::optional<std::string> label(std::int64_t vpid) override {
    return vpid == kStranger.vpid ? std::nullopt : std::optional(fmt::format("talker-{}", vpid - 100));
  }
  bool lives(std::int64_t vpid) override { return !ended.contains(vpid); }
  std::set<std::int64_t> ended;
};

// A system that is recorded: its times are milliseconds.
class LiveConditionsTest : public ::testing::Test {
 protected:
  // Makes a node /talker with a publisher of /chatter and a timer.
  void make(std::int64_t time, const testing::Thread& who = kTalker) {
    write(time, who, ros2::RclInit{0x1, "8.2.0"});
    write(time, who, ros2::RclNodeInit{0x10, 0x11, "talker", "/"});
    write(time, who, ros2::RmwPublisherInit{0x20, {}});
    write(time, who, ros2::RclPublisherInit{0x21, 0x10, 0x20, "/chatter", 10});
    write(time, who, ros2::RclTimerInit{0x30, 100 * kMs});
    write(time, who, ros2::RclcppTimerCallbackAdded{0x30, 0x31});
    write(time, who, ros2::RclcppTimerLinkNode{0x30, 0x10});
  }
  // Makes a node /listener with a subscription to /chatter and a client of /plan.
  void make_listener(std::int64_t time) {
    write(time, kListener, ros2::RclInit{0x1, "8.2.0"});
    write(time, kListener, ros2::RclNodeInit{0x50, 0x51, "listener", "/"});
    write(time, kListener, ros2::RmwSubscriptionInit{0x60, {}});
    write(time, kListener, ros2::RclSubscriptionInit{0x61, 0x50, 0x60, "/chatter", 10});
    write(time, kListener, ros2::RclcppSubscriptionInit{0x61, 0x62});
    write(time, kListener, ros2::RclcppSubscriptionCallbackAdded{0x62, 0x63});
    write(time, kListener, ros2::RmwClientInit{0x70, {}});
    write(time, kListener, ros2::RclClientInit{0x71, 0x50, 0x70, "/plan"});
  }
  // The message of that time gets to its callback so much later.
  void hear(std::int64_t published, std::int64_t after, std::int64_t runs = 1) {
    const std::int64_t time = published + after;
    write(time, kListener, ros2::RmwTake{0x60, 0x40, static_cast<std::int64_t>(kBegin + published * kMs), true});
    write(time, kListener, ros2::CallbackStart{0x63, false});
    write(time + runs, kListener, ros2::CallbackEnd{0x63});
  }
  // A request, and so much later its response.
  void call(std::int64_t number, std::int64_t time, std::int64_t takes) {
    write(time, kListener, ros2::RmwSendRequest{0x70, 0x41, number});
    write(time + takes, kListener, ros2::RmwTakeResponse{0x70, 0x42, number, 1, true});
  }
  void publish(std::int64_t time, const testing::Thread& who = kTalker) {
    write(time, who, ros2::CallbackStart{0x31, false});
    write(time, who, ros2::RclPublish{0x21, 0x40});
    write(time, who, ros2::RmwPublish{0x20, 0x40, static_cast<std::int64_t>(kBegin + time * kMs)});
    write(time, who, ros2::CallbackEnd{0x31});
  }
  void publish_each(std::int64_t period, std::int64_t from, std::int64_t until) {
    for (std::int64_t time = from; time <= until; time += period) {
      publish(time);
    }
  }
  template <class Event>
  void write(std::int64_t time, const testing::Thread& who, const Event& event) {
    writer_.write(0, kBegin + time * kMs, who, event);
  }

  // The rest was told, too: nothing has happened until then.
  std::vector<std::string> told_until(std::int64_t time) {
    writer_.finish();
    TraceReader(directory_.path()).read(conditions_);
    conditions_.advance(kBegin + time * kMs);
    return told_;
  }

  void note(const ConditionReport& report) {
    if (const auto* const changed = std::get_if<ConditionChanged>(&report)) {
      told_.push_back(fmt::format("{} {} {:.3f} {}", changed->id, changed->change.holds ? "holds" : "is over",
                                  changed->change.figure, fmt::join(changed->change.processes, " ")));
    } else if (const auto* const unseen = std::get_if<NameNotSeen>(&report)) {
      told_.push_back(fmt::format("{} unseen, there is {}", unseen->id, fmt::join(unseen->known, " ")));
    }
  }

  testing::TemporaryDirectory directory_;
  testing::TraceWriter writer_{directory_.path()};
  FakeLaunch launch_;
  std::vector<std::string> told_;
  LiveConditions conditions_{launch_, [this](const ConditionReport& report) { note(report); }};
};

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

LiveCondition late(Subject subject, const char* name, std::chrono::nanoseconds max, double share = 1) {
  return {.kind = Kind::kLate, .subject = subject, .name = name, .window = 1s, .max = max, .share = share};
}

TEST_F(LiveConditionsTest, AMessageIsLateForItsCallbackAndTheConditionEndsAfterAWindowWithoutAnother) {
  conditions_.watch(1, late(Subject::kTopic, "/chatter", 20ms));
  make(0);
  make_listener(0);
  for (const auto& [published, after] : {std::pair(100, 5), {200, 20}, {300, 35}, {400, 50}, {600, 5}}) {
    publish(published);
    hear(published, after);
  }
  EXPECT_THAT(told_until(1400), ElementsAre("1 holds 0.035 talker-3"));
  conditions_.advance(kBegin + 1500 * kMs);
  EXPECT_THAT(told_, ElementsAre("1 holds 0.035 talker-3", "1 is over 0.000 talker-3"));
}

TEST_F(LiveConditionsTest, AShareOfTheMessagesMayBeLate) {
  conditions_.watch(1, late(Subject::kTopic, "/chatter", 20ms, 0.8));
  make(0);
  make_listener(0);
  for (std::int64_t time = 100; time <= 1000; time += 100) {  // 2 of 10 are late: no more than a fifth at any time
    publish(time);
    hear(time, time == 500 || time == 1000 ? 30 : 5);
  }
  publish(1100);
  hear(1100, 31);
  EXPECT_THAT(told_until(1200), ElementsAre("1 holds 0.031 talker-3"));
}

TEST_F(LiveConditionsTest, ACallbackIsLateBeforeItEndsAndCountsOnce) {
  conditions_.watch(1, late(Subject::kNode, "/listener", 50ms));
  conditions_.watch(2, late(Subject::kNode, "/talker", 50ms));
  make(0);
  make_listener(0);
  publish(100);
  hear(100, 5, 40);
  publish(200);
  write(205, kListener, ros2::RmwTake{0x60, 0x40, static_cast<std::int64_t>(kBegin + 200 * kMs), true});
  write(205, kListener, ros2::CallbackStart{0x63, false});
  EXPECT_THAT(told_until(255), IsEmpty());
  conditions_.advance(kBegin + 260 * kMs);
  EXPECT_THAT(told_, ElementsAre("1 holds 0.055 talker-3"));
  conditions_.advance(kBegin + 900 * kMs);
  EXPECT_EQ(told_.size(), 1U);
}

TEST_F(LiveConditionsTest, ACallbackOfAProcessThatHasEndedIsNotLate) {
  conditions_.watch(1, late(Subject::kNode, "/listener", 50ms));
  make_listener(0);
  write(205, kListener, ros2::CallbackStart{0x63, false});
  launch_.ended = {kListener.vpid};
  EXPECT_THAT(told_until(9000), IsEmpty());
}

TEST_F(LiveConditionsTest, AResponseIsLateForItsClient) {
  conditions_.watch(1, late(Subject::kService, "/plan", 100ms));
  make_listener(0);
  call(1, 100, 90);
  call(2, 300, 150);
  EXPECT_THAT(told_until(500), ElementsAre("1 holds 0.150 talker-3"));
}

// The end of one run and the begin of the next are lost: what is left looks like one long run.
TEST_F(LiveConditionsTest, ARunAroundLostEventsIsNotLate) {
  conditions_.watch(1, late(Subject::kNode, "/listener", 50ms));
  make_listener(0);
  write(1000, kListener, ros2::CallbackStart{0x63, false});
  writer_.end_packet(0);
  writer_.discard_events(0, 2);
  write(1200, kListener, ros2::CallbackEnd{0x63});
  write(1300, kListener, ros2::CallbackStart{0x63, false});
  write(1310, kListener, ros2::CallbackEnd{0x63});
  EXPECT_THAT(told_until(1400), IsEmpty());
}

TEST_F(LiveConditionsTest, AfterLostEventsOneMayBeLateButNoShareIsKnown) {
  conditions_.watch(1, late(Subject::kTopic, "/chatter", 20ms));
  conditions_.watch(2, late(Subject::kTopic, "/chatter", 20ms, 0.5));
  make(0);
  make_listener(0);
  writer_.end_packet(0);
  write(1200, kTalker, ros2::RclNodeInit{0x99, 0x98, "other", "/"});
  writer_.discard_events(0, 3);
  write(1210, kTalker, ros2::RclNodeInit{0x97, 0x96, "another", "/"});
  writer_.end_packet(0);
  publish(1300);
  hear(1300, 30);
  EXPECT_THAT(told_until(1400), ElementsAre("1 holds 0.030 talker-3"));
}

TEST_F(LiveConditionsTest, WhatIsLateIsMissedWhereNobodyWaitsForIt) {
  conditions_.watch(1, {.kind = Kind::kLate, .name = "/chater", .window = 1s, .max = 1ms});
  conditions_.watch(2, {.kind = Kind::kLate, .subject = Subject::kService, .name = "/plann", .window = 1s, .max = 1ms});
  make(0);
  make_listener(0);
  told_until(10);
  conditions_.tell_unseen(100s);
  conditions_.tell_unseen(110s);
  EXPECT_THAT(told_, ElementsAre("1 unseen, there is /chatter", "2 unseen, there is /plan"));
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
