// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/executors.hpp"

#include <gtest/gtest.h>

#include "tests/unit/twin/timeline_by_hand.hpp"

namespace tracing::twin {
namespace {

// Two threads of a process with a callback each.
struct TwoThreads : testing::HandRecording {
  TwoThreads() {
    add_process();
    node = add_node("/node");
    first = add_timer(node);
    second = add_timer(node);
    left = add_thread(1);
    right = add_thread(2);
  }
  timeline::Index node, first, second, left, right;
};

TEST(Executors, ThreadsThatWaitAtTheSameTimeAreOfTwoExecutors) {
  TwoThreads hand;
  hand.run(hand.first, hand.left, 10, 20);
  hand.run(hand.second, hand.right, 12, 30);
  hand.wait(1, 20, 100);
  hand.wait(2, 30, 90);
  const FoundExecutors found = find_executors(hand.recording);
  ASSERT_EQ(found.executors.size(), 2u);
  EXPECT_EQ(found.executors[0].threads, std::vector<std::int64_t>{1});
  EXPECT_TRUE(found.executors[0].waits);
  EXPECT_NE(found.executor_of[hand.first], found.executor_of[hand.second]);
}

TEST(Executors, ThreadsThatWaitInTurnsAreOfOneExecutor) {
  TwoThreads hand;
  hand.run(hand.first, hand.left, 10, 20);
  hand.run(hand.second, hand.right, 12, 30);
  hand.wait(1, 20, 100);
  hand.wait(2, 100, 190);
  hand.wait(3, 190, 200);  // a thread that never got anything to run
  const FoundExecutors found = find_executors(hand.recording);
  ASSERT_EQ(found.executors.size(), 1u);
  EXPECT_EQ(found.executors[0].threads, (std::vector<std::int64_t>{1, 2, 3}));
}

// As CARET tells them: without waits, and of callbacks that never met.
TEST(Executors, AndGroupsAreThoseThatTheTraceTells) {
  TwoThreads hand;
  hand.run(hand.first, hand.left, 10, 20);
  hand.run(hand.second, hand.right, 30, 40);
  hand.recording.timeline.executors = {{0, 0x1, "multi_threaded_executor"}};
  hand.recording.timeline.callback_groups = {{0, "mutually_exclusive"}, {0, "reentrant"}};
  hand.recording.timeline.callbacks[hand.first].group = 0;
  hand.recording.timeline.callbacks[hand.second].group = 1;
  const FoundExecutors found = find_executors(hand.recording);
  ASSERT_EQ(found.executors.size(), 1u);
  EXPECT_EQ(found.executors[0].threads, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(found.executors[0].recorded_kind, "multi_threaded_executor");
  ASSERT_EQ(found.groups.size(), 2u);
  EXPECT_FALSE(found.groups[found.group_of[hand.first]].reentrant);
  EXPECT_TRUE(found.groups[found.group_of[hand.second]].reentrant);
}

TEST(Executors, CallbacksThatRanAtTheSameTimeAreInTwoGroups) {
  TwoThreads hand;
  const timeline::Index third = hand.add_timer(hand.node);
  hand.wait(1, 0, 5);
  hand.wait(2, 5, 6);
  hand.run(hand.first, hand.left, 10, 20);
  hand.run(hand.second, hand.right, 12, 30);
  hand.run(third, hand.left, 40, 50);
  const FoundExecutors found = find_executors(hand.recording);
  EXPECT_NE(found.group_of[hand.first], found.group_of[hand.second]);
  EXPECT_EQ(found.group_of[hand.first], found.group_of[third]);
  EXPECT_FALSE(found.groups[found.group_of[hand.first]].reentrant);
}

TEST(Executors, ACallbackThatRanTwiceAtTheSameTimeIsReentrant) {
  TwoThreads hand;
  hand.run(hand.first, hand.left, 10, 20);
  hand.run(hand.first, hand.right, 12, 30);
  const FoundExecutors found = find_executors(hand.recording);
  ASSERT_EQ(found.executors.size(), 1u);
  EXPECT_FALSE(found.executors[0].waits);
  EXPECT_TRUE(found.groups[found.group_of[hand.first]].reentrant);
  EXPECT_EQ(found.group_of[hand.second], FoundExecutors::kNone);
}

}  // namespace
}  // namespace tracing::twin
