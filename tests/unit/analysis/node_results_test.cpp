// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/analysis/summary_objects.hpp"

namespace tracing {
namespace {

using NodeResults = testing::SummaryObjects;

TEST_F(NodeResults, AddUpTheCallbacksOfANode) {
  CallbackResult callback;
  callback.node = "/node";
  callback.durations.count = 3;
  callback.durations.mean_ns = 20;
  const std::vector<NodeResult> results = node_results(subjects, {callback, callback});
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].name, "/node");
  EXPECT_EQ(results[0].callbacks, 6u);
  EXPECT_EQ(results[0].callback_ns, 120);
}

TEST_F(NodeResults, OfLifecycleNodesTellTheirStates) {
  const AllocationCounter allocations(model);
  LifecycleTracker lifecycle(model, allocations, nobody);
  lifecycle.on({10, 1, 1}, ros2::RclLifecycleStateMachineInit{7, 5});
  lifecycle.on({50, 1, 1}, ros2::RclLifecycleTransition{5, "unconfigured", "configuring"});
  lifecycle.finish(90);
  const std::vector<LifecycleResult> results = lifecycle_results(subjects, lifecycle, allocations);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].node, "/node");
  EXPECT_EQ(results[0].state, "unconfigured");
  EXPECT_EQ(results[0].end_ns, 50);
  EXPECT_TRUE(results[0].ended);
  EXPECT_EQ(results[1].state, "configuring");
  EXPECT_FALSE(results[1].ended);
  EXPECT_EQ(results[1].allocations, std::nullopt);
}

}  // namespace
}  // namespace tracing
