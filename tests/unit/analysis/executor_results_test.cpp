// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/analysis/summary_objects.hpp"

namespace tracing {
namespace {

using ExecutorResults = testing::SummaryObjects;

TEST_F(ExecutorResults, NameTheLongestCallback) {
  ExecutorLoad executors;
  executors.on_executor_wait({{1, 5}, 1'000, 1'500});
  executors.on_callback({.thread = {1, 5}, .callback = 1, .begin_ns = 1'600, .end_ns = 1'900});
  executors.on_executor_wait({{1, 5}, 1'900, 2'000});
  const std::vector<ExecutorResult> results = executor_results(subjects, executors);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].process, 0u);
  EXPECT_EQ(results[0].vtid, 5);
  EXPECT_EQ(results[0].span_ns, 1'000);
  EXPECT_EQ(results[0].waited_ns, 600);
  EXPECT_DOUBLE_EQ(results[0].utilisation, 0.4);
  EXPECT_EQ(results[0].longest_callback, "/node, timer 100 ns");
  EXPECT_TRUE(results[0].doubtful);
}

TEST_F(ExecutorResults, OfExecutionsKeepTheAddressOfAnUnknownObject) {
  using Kind = ros2::ExecutionEvent::Kind;
  model.on({0, 1, 1}, ros2::RclServiceInit{5, 7, 6, "/add"});
  ExecutionTracker executions(model);
  std::optional<ActiveExecution> thread;
  executions.start(thread, {100, 1, 1}, {Kind::kService, 5});
  executions.end(thread, Kind::kClient, 110);
  executions.end(thread, Kind::kService, 120);
  executions.start(thread, {130, 1, 1}, {Kind::kWaitable, 0xaa});
  const std::vector<ExecutionResult> results = execution_results(subjects, executions);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].node, "/node");
  EXPECT_EQ(results[0].service, "/add");
  EXPECT_EQ(results[0].address, 0u);
  EXPECT_EQ(results[0].durations.max_ns, 20);
  EXPECT_EQ(results[1].kind, ExecutionResult::Kind::kWaitable);
  EXPECT_EQ(results[1].address, 0xaau);
  EXPECT_EQ(results[1].count, 1u);
  EXPECT_EQ(results[1].durations.count, 0u);
}

}  // namespace
}  // namespace tracing
