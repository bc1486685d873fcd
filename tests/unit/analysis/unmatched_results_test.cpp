// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/analysis/summary_objects.hpp"

namespace tracing {
namespace {

using UnmatchedResults = testing::SummaryObjects;

TEST_F(UnmatchedResults, AreEventsWithoutTheOneThatBelongsToThem) {
  const AllocationCounter allocations(model);
  DeliveryStatistics deliveries(model);
  EventJoin join(model, allocations, deliveries);
  join.on_event({100, 1, 1}, ros2::CallbackEnd{0xcb});
  join.on_event({110, 1, 1}, ros2::RmwPublish{1, 9, 777});
  join.on_event({120, 1, 1}, ros2::RmwTake{99, 9, 777, true});
  join.on_event({130, 1, 1}, ros2::CallbackStart{0xcb, false});
  join.finish();
  const std::vector<UnmatchedResult> results = unmatched_results(model, join, deliveries);
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[0].reason, "no end: an exception, a killed process, or it ran when the trace ended");
  EXPECT_EQ(results[1].reason, "no begin: it ran when the trace began, or the begin was lost");
  EXPECT_EQ(results[2].reason,
            "no subscription took the message: not connected, ignored by those of its own process, or lost");
  EXPECT_EQ(results[3].reason, "the creation of the subscription is not in the trace");
  for (const UnmatchedResult& result : results) {
    EXPECT_EQ(result.count, 1u);
  }
}

}  // namespace
}  // namespace tracing
