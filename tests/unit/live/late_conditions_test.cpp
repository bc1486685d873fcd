// SPDX-License-Identifier: Apache-2.0
// Conditions on what takes too long, and on messages that are lost.
#include "tests/unit/live/recorded_launch.hpp"

namespace tracing {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Kind = LiveCondition::Kind;
using Subject = LiveCondition::Subject;
using LateConditionsTest = RecordedLaunch;

LiveCondition late(Subject subject, const char* name, std::chrono::nanoseconds max, double share = 1) {
  return {.kind = Kind::kLate, .subject = subject, .name = name, .window = 1s, .max = max, .share = share};
}

TEST_F(LateConditionsTest, AMessageIsLateForItsCallbackAndTheConditionEndsAfterAWindowWithoutAnother) {
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

TEST_F(LateConditionsTest, AShareOfTheMessagesMayBeLate) {
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

TEST_F(LateConditionsTest, ACallbackIsLateBeforeItEndsAndCountsOnce) {
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

TEST_F(LateConditionsTest, ACallbackOfAProcessThatHasEndedIsNotLate) {
  conditions_.watch(1, late(Subject::kNode, "/listener", 50ms));
  make_listener(0);
  write(205, kListener, ros2::CallbackStart{0x63, false});
  launch_.ended = {kListener.vpid};
  EXPECT_THAT(told_until(9000), IsEmpty());
}

TEST_F(LateConditionsTest, AResponseIsLateForItsClient) {
  conditions_.watch(1, late(Subject::kService, "/plan", 100ms));
  make_listener(0);
  call(1, 100, 90);
  call(2, 300, 150);
  EXPECT_THAT(told_until(500), ElementsAre("1 holds 0.150 talker-3"));
}

// The end of one run and the begin of the next are lost: what is left looks like one long run.
TEST_F(LateConditionsTest, ARunAroundLostEventsIsNotLate) {
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

TEST_F(LateConditionsTest, AfterLostEventsOneMayBeLateButNoShareIsKnown) {
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

TEST_F(LateConditionsTest, WhatIsLateIsMissedWhereNobodyWaitsForIt) {
  conditions_.watch(1, {.kind = Kind::kLate, .name = "/chater", .window = 1s, .max = 1ms});
  conditions_.watch(2, {.kind = Kind::kLate, .subject = Subject::kService, .name = "/plann", .window = 1s, .max = 1ms});
  make(0);
  make_listener(0);
  told_until(10);
  conditions_.tell_unseen(100s);
  conditions_.tell_unseen(110s);
  EXPECT_THAT(told_, ElementsAre("1 unseen, there is /chatter", "2 unseen, there is /plan"));
}

TEST_F(LateConditionsTest, AResultOfAnActionIsLateForItsClient) {
  conditions_.watch(1, late(Subject::kAction, "/drive", 1s));
  conditions_.watch(2, late(Subject::kAction, "/drives", 1s));
  make_listener(0);
  call(1, 100, 900, 0x80);
  call(2, 2000, 1500, 0x80);
  EXPECT_THAT(told_until(4000), ElementsAre("1 holds 1.500 talker-3"));
  conditions_.tell_unseen(100s);
  conditions_.tell_unseen(110s);
  EXPECT_EQ(told_.back(), "2 unseen, there is /drive");
}

// A timer of 100 ms.
TEST_F(LateConditionsTest, ATimerIsLateAgainstItsPeriodAndNotAgainstItsLastCall) {
  conditions_.watch(1, late(Subject::kTimer, "/talker", 20ms));
  make(0);
  for (const std::int64_t time : {100, 200, 305, 400, 519, 600, 721, 800}) {
    publish(time);
  }
  EXPECT_THAT(told_until(900), ElementsAre("1 holds 0.021 talker-1"));
}

TEST_F(LateConditionsTest, ATimerThatHasMissedPeriodsIsLateByAllOfThem) {
  conditions_.watch(1, late(Subject::kTimer, "/talker", 20ms));
  make(0);
  publish(100);
  publish(450);  // those of 200 and 300 are left out
  publish(500);
  publish(610);
  EXPECT_THAT(told_until(700), ElementsAre("1 holds 0.250 talker-1"));
}

// It was called late when its first call was seen.
TEST_F(LateConditionsTest, TheEarliestCallShowsWhenATimerIsDue) {
  conditions_.watch(1, late(Subject::kTimer, "/talker", 20ms));
  make(0);
  publish(115);
  publish(200);
  publish(325);
  EXPECT_THAT(told_until(400), ElementsAre("1 holds 0.025 talker-1"));
}

// The program has started it again at another time.
TEST_F(LateConditionsTest, ATimerWhoseCallsAreAllLaterIsDueLater) {
  conditions_.watch(1, late(Subject::kTimer, "/talker", 20ms));
  make(0);
  publish_each(100, 100, 500);
  publish_each(100, 650, 9000);
  EXPECT_THAT(told_until(9000), ElementsAre("1 holds 0.050 talker-1", "1 is over 0.000 talker-1"));
}

// It has to wait for others, now longer and now shorter.
TEST_F(LateConditionsTest, ATimerThatIsAlwaysLateStaysLate) {
  conditions_.watch(1, late(Subject::kTimer, "/talker", 20ms));
  make(0);
  publish_each(100, 100, 500);
  for (std::int64_t period = 6; period <= 60; ++period) {
    publish(period * 100 + 25 + 15 * (period % 2));
  }
  EXPECT_THAT(told_until(6050), ElementsAre("1 holds 0.025 talker-1"));
}

// A subscription that is transient local gets what was sent before it was there.
TEST_F(LateConditionsTest, AMessageThatIsOlderThanItsSubscriptionIsNotLate) {
  conditions_.watch(1, late(Subject::kTopic, "/chatter", 20ms));
  conditions_.watch(2, late(Subject::kChain, "/talker -> /listener", 20ms));
  make(0);
  publish(100);
  make_listener(5000);
  hear(100, 4910);
  publish(6000);
  hear(6000, 25);
  EXPECT_THAT(told_until(6100), ElementsAre("1 holds 0.025 talker-3", "2 holds 0.026 talker-1 talker-3"));
}

// The late ones of the process before do not count for the next one.
TEST_F(LateConditionsTest, AShareBeginsAnewWithTheNextProcess) {
  conditions_.watch(1, late(Subject::kNode, "/talker", 20ms, 0.5));
  constexpr testing::Thread kNext{102, 102, "talker"};
  const auto run = [&](std::int64_t time, std::int64_t takes, const testing::Thread& who) {
    write(time, who, ros2::CallbackStart{0x31, false});
    write(time + takes, who, ros2::CallbackEnd{0x31});
  };
  make(0);
  for (const std::int64_t time : {100, 200, 300}) {
    run(time, 30, kTalker);
  }
  launch_.ended = {kTalker.vpid};
  make(500, kNext);
  run(510, 1, kNext);
  run(520, 1, kNext);
  run(530, 30, kNext);
  EXPECT_THAT(told_until(600), ElementsAre("1 holds 0.030 talker-1", "1 is over 0.000 talker-2"));
}

// Programs declare links once.
TEST_F(LateConditionsTest, LinksOfMessagesHoldForAChainThatIsWatchedLater) {
  make(0);
  make_listener(0);
  write(0, kListener, ros2::RmwPublisherInit{0x90, {}});
  write(0, kListener, ros2::RclPublisherInit{0x91, 0x50, 0x90, "/merged", 10});
  write(0, kListener, ros2::MessageLinkPartialSync{{0x61}, {0x91}});
  write(10, kTalker, ros2::RmwSubscriptionInit{0xa0, {}});
  write(10, kTalker, ros2::RclSubscriptionInit{0xa1, 0x10, 0xa0, "/merged", 10});
  write(10, kTalker, ros2::RclcppSubscriptionInit{0xa1, 0xa2});
  write(10, kTalker, ros2::RclcppSubscriptionCallbackAdded{0xa2, 0xa3});
  publish(100);
  hear(100, 5);
  write(200, kListener, ros2::RmwPublish{0x90, 0x44, kBegin + 200 * kMs});
  write(201, kTalker, ros2::RmwTake{0xa0, 0x44, kBegin + 200 * kMs, true});
  write(201, kTalker, ros2::CallbackStart{0xa3, false});
  write(202, kTalker, ros2::CallbackEnd{0xa3});
  writer_.finish();
  class WatchAt final : public TraceSink {
   public:
    WatchAt(LiveConditions& to, LiveCondition condition) : to_(to), condition_(std::move(condition)) {}
    void on_event(const Event& event) override {
      if (event.timestamp_ns >= kBegin + 50 * kMs && std::exchange(waits_, false)) {
        to_.watch(1, condition_);
      }
      to_.on_event(event);
    }
    void on_loss(const Loss& loss) override { to_.on_loss(loss); }

   private:
    LiveConditions& to_;
    LiveCondition condition_;
    bool waits_ = true;
  } sink(conditions_, late(Subject::kChain, "/talker -> /listener -> /talker", 20ms));
  TraceReader(directory_.path()).read(sink);
  EXPECT_THAT(told_, ElementsAre("1 holds 0.102 talker-1 talker-3"));
}

TEST_F(LateConditionsTest, TheWayThroughAChainIsLate) {
  conditions_.watch(1, late(Subject::kChain, "/talker -> /lis*", 20ms));
  conditions_.watch(2, late(Subject::kChain, "/listener -> /talker", 1ms));
  make(0);
  make_listener(0);
  for (const auto& [published, after, runs] : {std::tuple(100, 5, 10), {200, 5, 15}, {300, 5, 16}, {400, 5, 1}}) {
    publish(published);
    hear(published, after, runs);
  }
  EXPECT_THAT(told_until(500), ElementsAre("1 holds 0.021 talker-1 talker-3"));
}

TEST_F(LateConditionsTest, AChainThatIsWatchedLaterAndOneThatIsForgotten) {
  conditions_.watch(1, late(Subject::kChain, "/talker -> /listener", 20ms));
  conditions_.forget(1);
  conditions_.watch(2, late(Subject::kChain, "/talker -> /listener", 10ms));
  make(0);
  make_listener(0);
  publish(100);
  hear(100, 5, 20);
  EXPECT_THAT(told_until(500), ElementsAre("2 holds 0.025 talker-1 talker-3"));
}

TEST_F(LateConditionsTest, OfAChainEachNodeMustBeThere) {
  conditions_.watch(1, late(Subject::kChain, "/talker -> /brake", 20ms));
  conditions_.watch(2, late(Subject::kChain, "/talker -> /listener", 20ms));
  make(0);
  make_listener(0);
  told_until(10);
  conditions_.tell_unseen(100s);
  conditions_.tell_unseen(110s);
  EXPECT_THAT(told_, ElementsAre("1 unseen, there is /listener /talker"));
}

LiveCondition loss(double share) {
  return {.kind = Kind::kLoss, .name = "/chatter", .window = 1s, .share = share};
}

TEST_F(LateConditionsTest, MessagesAreLostWhenALaterOneComes) {
  conditions_.watch(1, loss(1));
  make(0);
  make_listener(0);
  for (const std::int64_t time : {100, 200, 300, 400, 500, 600}) {
    publish(time);
    if (time != 300 && time != 400 && time != 600) {
      hear(time, 5);
    }
  }
  EXPECT_THAT(told_until(1500), ElementsAre("1 holds 2.000 talker-3"));
  conditions_.advance(kBegin + 1600 * kMs);
  EXPECT_THAT(told_, ElementsAre("1 holds 2.000 talker-3", "1 is over 0.000 talker-3"));
}

TEST_F(LateConditionsTest, AShareOfTheMessagesMayBeLost) {
  conditions_.watch(1, loss(0.8));
  make(0);
  make_listener(0);
  for (std::int64_t time = 100; time <= 900; time += 100) {  // one of five
    publish(time);
    if (time != 500) {
      hear(time, 5);
    }
  }
  for (const std::int64_t time : {1000, 1100, 1200}) {
    publish(time);
  }
  hear(1200, 5);
  EXPECT_THAT(told_until(1300), ElementsAre("1 holds 3.000 talker-3"));
}

// The events of the messages between are lost, not the messages.
TEST_F(LateConditionsTest, AGapAroundLostEventsIsNoLossOfMessages) {
  conditions_.watch(1, loss(1));
  make(0);
  make_listener(0);
  publish(100);
  hear(100, 5);
  publish(200);
  writer_.end_packet(0);
  writer_.discard_events(0, 3);
  write(300, kTalker, ros2::RclNodeInit{0x99, 0x98, "other", "/"});
  writer_.end_packet(0);
  publish(400);
  hear(400, 5);
  publish(500);
  publish(600);
  hear(600, 5);
  EXPECT_THAT(told_until(700), ElementsAre("1 holds 1.000 talker-3"));
}

}  // namespace
}  // namespace tracing
