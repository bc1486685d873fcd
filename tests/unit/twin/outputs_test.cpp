// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/outputs.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/timeline_by_hand.hpp"

namespace tracing::twin {
namespace {

struct OneNode : testing::HandRecording {
  OneNode() {
    add_process();
    node = add_node("/node");
    thread = add_thread(1);
  }
  timeline::Index node, thread;
};

TEST(Outputs, EachRunSendsAtItsPlace) {
  OneNode hand;
  const timeline::Index timer = hand.add_timer(hand.node);
  std::vector<Sending> sendings;
  for (std::int64_t begin = 0; begin < 1000; begin += 100) {
    const timeline::Index run = hand.run(timer, hand.thread, begin, begin + 40);
    sendings.push_back({begin + 10, begin + 20, run});
  }
  const auto outputs = outputs_of(hand.recording, sendings);
  ASSERT_EQ(outputs.size(), 1u);
  const Output& output = outputs.at(timer);
  EXPECT_EQ(output.rule, Output::Rule::kAlways);
  EXPECT_EQ(output.times, 1u);
  EXPECT_DOUBLE_EQ(output.called, 0.25);
  EXPECT_DOUBLE_EQ(output.sent, 0.5);
}

TEST(Outputs, EveryThirdRunSendsTwoMessages) {
  OneNode hand;
  const timeline::Index timer = hand.add_timer(hand.node);
  std::vector<Sending> sendings;
  for (std::int64_t count = 1; count <= 30; ++count) {
    const timeline::Index run = hand.run(timer, hand.thread, 100 * count, 100 * count + 40);
    if (count % 3 == 0) {
      sendings.push_back({100 * count, 100 * count, run});
      sendings.push_back({100 * count, 100 * count, run});
    }
  }
  const Output output = outputs_of(hand.recording, sendings).at(timer);
  EXPECT_EQ(output.rule, Output::Rule::kEvery);
  EXPECT_EQ(output.every, 3u);
  EXPECT_EQ(output.times, 2u);
}

// As a fusion does: the left input comes twice as often.
TEST(Outputs, AFusionSendsWhenAllInputsHaveCome) {
  OneNode hand;
  const timeline::Index left = hand.add_subscription(hand.node, "/left");
  const timeline::Index right = hand.add_subscription(hand.node, "/right");
  std::vector<Sending> sendings;
  for (std::int64_t count = 0; count < 20; ++count) {
    const std::int64_t begin = 1000 * count;
    hand.run(left, hand.thread, begin, begin + 10);
    // In turns the right one comes last, or a second left one does.
    const timeline::Index last = count % 2 == 0 ? hand.run(right, hand.thread, begin + 300, begin + 320)
                                                : (hand.run(left, hand.thread, begin + 200, begin + 210),
                                                   hand.run(right, hand.thread, begin + 300, begin + 320));
    sendings.push_back({begin + 310, begin + 315, last});
  }
  // Only one of them ever sends, but not alone: the rule of the right one is "always".
  auto outputs = outputs_of(hand.recording, sendings);
  EXPECT_EQ(outputs.at(right).rule, Output::Rule::kAlways);

  // Now the left one is the last one in half of the cases.
  OneNode other;
  const timeline::Index first = other.add_subscription(other.node, "/left");
  const timeline::Index second = other.add_subscription(other.node, "/right");
  sendings.clear();
  for (std::int64_t count = 0; count < 20; ++count) {
    const std::int64_t begin = 1000 * count;
    other.run(count % 2 == 0 ? first : second, other.thread, begin, begin + 10);
    const timeline::Index last = other.run(count % 2 == 0 ? second : first, other.thread, begin + 300, begin + 320);
    sendings.push_back({begin + 310, begin + 315, last});
  }
  outputs = outputs_of(other.recording, sendings);
  EXPECT_EQ(outputs.at(first).rule, Output::Rule::kJoin);
  EXPECT_EQ(outputs.at(second).inputs, (std::vector<Index>{first, second}));
}

TEST(Outputs, WhatHasNoRuleHasAChance) {
  OneNode hand;
  const timeline::Index timer = hand.add_timer(hand.node);
  std::vector<Sending> sendings;
  for (std::int64_t count = 0; count < 30; ++count) {
    const timeline::Index run = hand.run(timer, hand.thread, 100 * count, 100 * count + 40);
    if (count % 7 == 0 || count % 5 == 0) {
      sendings.push_back({100 * count, 100 * count, run});
    }
  }
  const Output output = outputs_of(hand.recording, sendings).at(timer);
  EXPECT_EQ(output.rule, Output::Rule::kChance);
  EXPECT_DOUBLE_EQ(output.chance, 10.0 / 30);
}

}  // namespace
}  // namespace tracing::twin
