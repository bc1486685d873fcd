// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/delays.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/timeline_by_hand.hpp"

namespace tracing::twin {
namespace {

using Times = std::vector<std::int64_t>;

std::vector<WayTimes> ways_in(const testing::HandRecording& hand) {
  return way_times(hand.recording, find_executors(hand.recording), RunTimes(hand.recording));
}

TEST(Delays, TellsWhatWaitedForTheExecutorFromWhatDidNot) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index subscription = hand.add_subscription(node, "/a");
  hand.send(100, hand.run(subscription, thread, 130, 200));  // nothing before
  hand.send(150, hand.run(subscription, thread, 207, 300));  // while the first one ran
  hand.send(400, hand.run(subscription, thread, 440, 500));
  const std::vector<WayTimes> times = ways_in(hand);
  EXPECT_EQ(times[subscription].delays.values, (std::vector<std::int64_t>{30, 40}));
  EXPECT_EQ(times[subscription].gaps.values, std::vector<std::int64_t>{7});
}

// Two threads that share the messages are hardly ever both busy. When they are, it is the machine that keeps them.
TEST(Delays, FewGapsOfSeveralThreadsAreNotThoseOfOne) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index first = hand.add_thread(1);
  const timeline::Index second = hand.add_thread(2);
  const timeline::Index subscription = hand.add_subscription(node, "/a");
  hand.recording.timeline.publishers = {{node, 0}};
  for (int i = 0; i < 20; ++i) {
    hand.send(1000 * i + 100, hand.run(subscription, i % 2 == 0 ? first : second, 1000 * i + 130, 1000 * i + 200), 0);
  }
  hand.run(subscription, first, 20'100, 20'400);
  hand.run(subscription, second, 20'120, 20'400);
  hand.send(20'300, hand.run(subscription, first, 29'000, 29'100), 0);
  const std::vector<WayTimes> times = ways_in(hand);
  EXPECT_EQ(times[subscription].gaps.quantile(0.99), 30);
  EXPECT_EQ(times[subscription].delays.quantile(1), 8'700);
  EXPECT_TRUE(times[subscription].near_delays.empty());
}

TEST(Delays, OfSeveralRunsBeforeItTheGapIsBehindTheLastOne) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index timer = hand.add_timer(node);
  const timeline::Index subscription = hand.add_subscription(node, "/a");
  hand.run(timer, thread, 1'000, 1'100);
  hand.run(timer, thread, 1'110, 1'200);
  hand.send(1'050, hand.run(subscription, thread, 1'207, 1'300));
  EXPECT_EQ(ways_in(hand)[subscription].gaps.values, Times{7});
}

// The executor was free again before the message could be there.
TEST(Delays, AnExecutorThatIsBusyForAMomentDoesNotKeepAMessage) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index timer = hand.add_timer(node);
  const timeline::Index subscription = hand.add_subscription(node, "/a");
  hand.send(500, hand.run(subscription, thread, 540, 550));
  hand.run(timer, thread, 990, 1'010);
  hand.send(1'000, hand.run(subscription, thread, 1'050, 1'060));
  EXPECT_EQ(ways_in(hand)[subscription].delays.values, (Times{40, 50}));
}

TEST(Delays, MessagesOfTheSameProcessHaveTimesOfTheirOwn) {
  testing::HandRecording hand;
  hand.add_process();
  hand.add_process();
  const timeline::Index here = hand.add_node("/here", 1);
  const timeline::Index there = hand.add_node("/there", 0);
  const timeline::Index subscription = hand.add_subscription(here, "/a");
  const timeline::Index thread = hand.add_thread(2, 1);
  hand.recording.timeline.publishers = {{here, 0}, {there, 0}};
  hand.send(100, hand.run(subscription, thread, 105, 110), 0);
  hand.send(200, hand.run(subscription, thread, 260, 270), 1);
  const WayTimes ways = ways_in(hand)[subscription];
  EXPECT_EQ(ways.near_delays.values, Times{5});
  EXPECT_EQ(ways.delays.values, Times{60});
}

// The executor runs the callback that sends it.
TEST(Delays, AMessageThatAlwaysWaitsForItsSenderNeedsTheGap) {
  testing::HandRecording hand;
  hand.add_process();
  hand.add_process();
  const timeline::Index here = hand.add_node("/here", 1);
  const timeline::Index there = hand.add_node("/there", 0);
  const timeline::Index timer = hand.add_timer(here, 10'000);
  const timeline::Index subscription = hand.add_subscription(here, "/a");
  const timeline::Index thread = hand.add_thread(2, 1);
  hand.recording.timeline.publishers = {{here, 0}, {there, 0}};
  for (const std::int64_t time : {10'000, 20'000}) {
    hand.run(timer, thread, time, time + 100);
    hand.send(time + 50, hand.run(subscription, thread, time + 107, time + 110), 0);
    hand.send(time + 500, hand.run(subscription, thread, time + 900, time + 910), 1);
  }
  const WayTimes ways = ways_in(hand)[subscription];
  EXPECT_EQ(ways.near_delays.values, (Times{7, 7}));
  EXPECT_EQ(ways.delays.values, (Times{400, 400}));
  EXPECT_EQ(ways.gaps.values, (Times{7, 7}));
}

TEST(Delays, ATimerIsCalledALittleLate) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index timer = hand.add_timer(node, 1'000);
  for (const std::int64_t start : {2'700, 3'000, 4'001, 5'020, 6'000, 7'001, 8'002}) {  // the first one in its own time
    hand.run(timer, thread, start, start + 10);
  }
  EXPECT_EQ(ways_in(hand)[timer].delays.values, (Times{0, 0, 1, 1, 2, 20}));
}

}  // namespace
}  // namespace tracing::twin
