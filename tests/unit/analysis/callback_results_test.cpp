// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/analysis/summary_objects.hpp"

namespace tracing {
namespace {

using CallbackResults = testing::SummaryObjects;

TEST_F(CallbackResults, NameTheOwnerAndComeByOwner) {
  CallbackTracker callbacks(nobody);
  CallbackTiming timing(model);
  ActiveCallbacks active;
  callbacks.start({1, 1}, active, {0xee, 1, 100, false});
  callbacks.end({1, 1}, active, 0xee, 130);
  callbacks.start({1, 1}, active, {0xcb, 0, 140, false});
  callbacks.abandon({1, 1}, active, 150);
  const std::vector<CallbackResult> results = callback_results(subjects, callbacks, timing, HoldUps(model));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].id, 0u);
  EXPECT_EQ(results[0].owner, CallbackResult::Owner::kSubscription);
  EXPECT_EQ(results[0].owner_name, "/topic");
  EXPECT_EQ(results[0].unfinished, 1u);
  EXPECT_EQ(results[1].owner, CallbackResult::Owner::kTimer);
  EXPECT_EQ(results[1].period_ns, 100);
  EXPECT_EQ(results[1].durations.max_ns, 30);
  for (const CallbackResult& result : results) {
    EXPECT_EQ(result.process, 0u);
    EXPECT_EQ(result.node, "/node");
    EXPECT_TRUE(result.doubtful);
    EXPECT_EQ(result.allocations, std::nullopt);
  }
}

TEST_F(CallbackResults, LeaveOutACallbackThatNeverRan) {
  CallbackTracker callbacks(nobody);
  ActiveCallbacks active;
  callbacks.start({1, 1}, active, {0xee, 1, 100, false});
  callbacks.end({1, 1}, active, 0xee, 130);
  EXPECT_EQ(callback_results(subjects, callbacks, CallbackTiming(model), HoldUps(model)).size(), 1u);
}

}  // namespace
}  // namespace tracing
