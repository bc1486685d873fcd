// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/callback_tracker.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

constexpr ThreadId kOneThread{1, 2};

struct CallbackTrackerTest : ::testing::Test, ExecutionSink {
  void on_callback_begin(const CallbackInstance& instance) override { begins.push_back(instance); }
  void on_callback(const CallbackInstance& instance) override { ends.push_back(instance); }

  std::vector<CallbackInstance> begins;
  std::vector<CallbackInstance> ends;
  ActiveCallbacks active;  // of kOneThread
  CallbackTracker tracker{*this};
};

TEST_F(CallbackTrackerTest, TellsACallbackWithinAnother) {
  tracker.start(kOneThread, active, {0xa, 0, 100, false});
  tracker.start(kOneThread, active, {0xb, 1, 110, true});
  tracker.end(kOneThread, active, 0xb, 130);
  tracker.end(kOneThread, active, 0xa, 150);
  ASSERT_EQ(begins.size(), 2u);
  EXPECT_FALSE(begins[0].nested);
  EXPECT_TRUE(begins[1].nested);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0].callback, 1u);
  EXPECT_TRUE(ends[0].nested);
  EXPECT_TRUE(ends[0].intra_process);
  EXPECT_EQ(ends[1].end_ns - ends[1].begin_ns, 50);
  EXPECT_TRUE(ends[1].finished);
  EXPECT_EQ(tracker.records()[1].intra_process, 1u);
}

TEST_F(CallbackTrackerTest, CountsAnEndWithoutABegin) {
  tracker.end(kOneThread, active, 0xa, 150);
  EXPECT_TRUE(ends.empty());
  EXPECT_EQ(tracker.ends_without_begin(), 1u);
}

TEST_F(CallbackTrackerTest, EndsAnInstanceThatAnExceptionLeftWhenTheCallbackRunsAgain) {
  tracker.start(kOneThread, active, {0xa, 0, 100, false});
  tracker.start(kOneThread, active, {0xa, 0, 200, false});
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_FALSE(ends[0].finished);
  EXPECT_EQ(ends[0].end_ns, 200);
  EXPECT_EQ(tracker.records()[0].unfinished, 1u);
}

TEST_F(CallbackTrackerTest, TellsWhatStillRunsAtTheEndOfTheTrace) {
  tracker.start(kOneThread, active, {0xa, 0, 100, false});
  tracker.abandon(kOneThread, active, 300);
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_FALSE(ends[0].finished);
  EXPECT_EQ(ends[0].end_ns, 300);
  EXPECT_EQ(tracker.records()[0].unfinished, 1u);
}

}  // namespace
}  // namespace tracing
