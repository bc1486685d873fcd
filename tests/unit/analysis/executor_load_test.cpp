// SPDX-License-Identifier: Apache-2.0
// How busy the threads of executors are.
#include <gtest/gtest.h>

#include "tests/unit/analysis/ros2_feed.hpp"

namespace tracing {
namespace {

using testing::Feed;

TEST(ExecutorLoad, IsTheTimeWithoutWaiting) {
  Feed feed;
  feed(ros2::RclNodeInit{1, 0, "busy", "/"})(ros2::RclTimerInit{3, 100})(ros2::RclcppTimerCallbackAdded{3, 0xee});
  feed(ros2::RclcppTimerLinkNode{3, 1});
  feed.at(1'000)(ros2::RclcppExecutorWaitForWork{-1}).at(1'600)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'610)(ros2::CallbackStart{0xee, false}).at(1'650)(ros2::CallbackEnd{0xee});
  feed.at(1'660)(ros2::RclcppExecutorWaitForWork{-1}).at(1'700)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'710)(ros2::CallbackStart{0xee, false}).at(1'990)(ros2::CallbackEnd{0xee});
  feed.at(1'995)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'996)(ros2::RclcppExecutorWaitForWork{-1}).at(2'000)(ros2::RclcppExecutorGetNextReady{});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.executors.size(), 1u);
  const ExecutorResult& executor = results.executors[0];
  EXPECT_EQ(executor.vtid, 71);
  EXPECT_EQ(executor.span_ns, 1'000);
  EXPECT_EQ(executor.callbacks, 2u);
  EXPECT_EQ(executor.callback_ns, 40 + 280);
  EXPECT_EQ(executor.waited_ns, 600 + 40 + 4);
  EXPECT_DOUBLE_EQ(executor.utilisation, 0.356);
  EXPECT_EQ(executor.longest_busy_ns, 296);
  EXPECT_EQ(executor.longest_busy_begin_ns, 1'700);
  EXPECT_EQ(executor.longest_callback, "/busy, timer 100 ns");
}

TEST(ExecutorLoad, ACallbackThatSpinsHoldsThoseThatRanWithinIt) {
  Feed feed;
  feed.at(1'000)(ros2::RclcppExecutorWaitForWork{-1}).at(1'100)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'200)(ros2::CallbackStart{1, false}).at(1'210)(ros2::CallbackStart{2, false});
  feed.at(1'220)(ros2::CallbackEnd{2}).at(1'230)(ros2::CallbackStart{3, false}).at(1'240)(ros2::CallbackEnd{3});
  feed.at(1'300)(ros2::CallbackEnd{1}).at(1'400)(ros2::CallbackStart{2, false}).at(1'405)(ros2::CallbackEnd{2});
  const ExecutorResult executor = feed.results().executors.at(0);
  EXPECT_EQ(executor.callbacks, 2u);
  EXPECT_EQ(executor.callback_ns, 100 + 5);
}

TEST(ExecutorLoad, ACallbackWhoseEndIsLostDoesNotHideThoseThatFollow) {
  Feed feed;
  feed.at(1'000)(ros2::RclcppExecutorWaitForWork{-1}).at(1'100)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'200)(ros2::CallbackStart{1, false});
  for (std::int64_t i = 0; i < 3'000; ++i) {
    feed.at(2'000 + 10 * i)(ros2::CallbackStart{2, false}).at(2'004 + 10 * i)(ros2::CallbackEnd{2});
  }
  const ExecutorResult executor = feed.results().executors.at(0);
  EXPECT_EQ(executor.callbacks, 3'000u);
  EXPECT_EQ(executor.callback_ns, 12'000);
}

// One thread waits for work with a lock; the other one waits for the lock.
TEST(ExecutorLoad, AThreadIsNotBusyWhileAnotherThreadOfTheExecutorWaitsForWork) {
  Feed feed;
  feed.at(1'000).in(0, 71)(ros2::RclcppExecutorWaitForWork{-1});
  feed.at(1'100).in(0, 71)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'110).in(0, 72)(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorWaitForWork{-1});
  feed.at(1'120).in(0, 71)(ros2::CallbackStart{1, false}).at(1'150)(ros2::CallbackEnd{1});
  feed.at(1'900).in(0, 72)(ros2::RclcppExecutorGetNextReady{}).at(1'910)(ros2::CallbackStart{2, false});
  feed.at(1'905).in(0, 71)(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorWaitForWork{-1});
  feed.at(1'950).in(0, 72)(ros2::CallbackEnd{2});
  feed.at(2'000).in(0, 71)(ros2::RclcppExecutorGetNextReady{});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.executors.size(), 2u);
  EXPECT_EQ(results.executors[0].waited_ns, 100 + 755 + 85);
  EXPECT_DOUBLE_EQ(results.executors[0].utilisation, 0.06);
  EXPECT_EQ(results.executors[0].longest_busy_ns, 50);
}

// It found nothing, and the other thread was faster.
TEST(ExecutorLoad, AThreadThatWasWokenForNothingIsNotBusyWhileAnotherOneWaits) {
  Feed feed;
  feed.at(1'000).in(0, 71)(ros2::RclcppExecutorWaitForWork{-1}).at(1'100)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'110).in(0, 72)(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorWaitForWork{-1});
  feed.at(1'900)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'910).in(0, 71)(ros2::RclcppExecutorGetNextReady{}).at(2'000)(ros2::CallbackStart{1, false});
  feed.at(2'100)(ros2::CallbackEnd{1});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.executors.size(), 2u);
  EXPECT_EQ(results.executors[0].waited_ns, 100 + 780);
}

TEST(ExecutorLoad, OfSeveralExecutorsAWaitTellsNothingOfAnotherThread) {
  Feed feed;
  feed.at(1'000).in(0, 71)(ros2::RclcppExecutorWaitForWork{-1});
  feed.at(1'050).in(0, 72)(ros2::RclcppExecutorWaitForWork{-1});
  feed.at(1'100).in(0, 71)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'200).in(0, 72)(ros2::RclcppExecutorGetNextReady{})(ros2::RclcppExecutorWaitForWork{-1});
  feed.at(1'300).in(0, 71)(ros2::RclcppExecutorWaitForWork{-1}).at(1'400)(ros2::RclcppExecutorGetNextReady{});
  feed.at(1'800).in(0, 72)(ros2::RclcppExecutorGetNextReady{});  // 71 has worked for 500 ns, without an event
  feed.at(1'900).in(0, 71)(ros2::RclcppExecutorGetNextReady{});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.executors.size(), 2u);
  EXPECT_EQ(results.executors[0].waited_ns, 100 + 100);
}

TEST(ExecutorLoad, IsTheTimeInCallbacksOfAnExecutorThatRecordsNoWaits) {
  Feed feed;
  feed.at(1'000)(ros2::CallbackStart{1, false}).at(1'100)(ros2::CallbackStart{2, false});
  feed.at(1'200)(ros2::CallbackEnd{2}).at(1'250)(ros2::CallbackEnd{1});
  feed.at(1'900)(ros2::CallbackStart{2, false}).at(2'000)(ros2::CallbackEnd{2});
  const Ros2Results results = feed.results();
  ASSERT_EQ(results.executors.size(), 1u);
  EXPECT_EQ(results.executors[0].callbacks, 2u);
  EXPECT_EQ(results.executors[0].callback_ns, 350);
  EXPECT_EQ(results.executors[0].waited_ns, std::nullopt);
  EXPECT_DOUBLE_EQ(results.executors[0].utilisation, 0.35);
}

}  // namespace
}  // namespace tracing
