// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/delays.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/timeline_by_hand.hpp"

namespace tracing::twin {
namespace {

TEST(Delays, TellsWhatWaitedForTheExecutorFromWhatDidNot) {
  testing::HandRecording hand;
  hand.add_process();
  const timeline::Index node = hand.add_node("/node");
  const timeline::Index thread = hand.add_thread(1);
  const timeline::Index subscription = hand.add_subscription(node, "/a");
  const auto message = [&](std::int64_t sent_ns, timeline::Index instance) {
    timeline::Message sent;
    sent.published_ns = sent_ns;
    sent.receiving_instance = instance;
    hand.recording.timeline.messages.push_back(sent);
  };
  message(100, hand.run(subscription, thread, 130, 200));  // nothing before
  message(150, hand.run(subscription, thread, 207, 300));  // while the first one ran
  message(400, hand.run(subscription, thread, 440, 500));
  const std::vector<WayTimes> times = way_times(hand.recording, find_executors(hand.recording), 2);
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
  const auto message = [&](std::int64_t sent_ns, timeline::Index instance) {
    timeline::Message sent;
    sent.published_ns = sent_ns;
    sent.receiving_instance = instance;
    hand.recording.timeline.messages.push_back(sent);
  };
  for (int i = 0; i < 20; ++i) {
    message(1000 * i + 100, hand.run(subscription, i % 2 == 0 ? first : second, 1000 * i + 130, 1000 * i + 200));
  }
  hand.run(subscription, first, 20'100, 20'400);
  hand.run(subscription, second, 20'120, 20'400);
  message(20'300, hand.run(subscription, first, 29'000, 29'100));
  const std::vector<WayTimes> times = way_times(hand.recording, find_executors(hand.recording), 2);
  EXPECT_EQ(times[subscription].gaps.quantile(0.99), 30);
}

}  // namespace
}  // namespace tracing::twin
