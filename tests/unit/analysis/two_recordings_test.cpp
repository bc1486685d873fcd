// SPDX-License-Identifier: Apache-2.0
// Two recordings below one directory whose processes have equal ids.
#include <gtest/gtest.h>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;
using testing::TraceWriter;

TEST(TwoRecordings, WithEqualProcessIdsHaveFourProcesses) {
  const TemporaryDirectory directory;
  for (const std::uint8_t identity : {1, 2}) {
    TraceWriter writer(directory.path() / std::to_string(identity), {.identity = identity});
    for (const auto& [time, thread, event] : testing::ping_pong_sequence()) {
      writer.write(thread.vpid == testing::kPing.vpid ? 0 : 1, time + identity, thread, event);
    }
    writer.finish();
  }
  TraceAnalysis analysis;
  TraceReader(directory.path()).read(analysis);
  const TraceResults results = analysis.finish();
  ASSERT_EQ(results.overview.processes.size(), 4u);
  EXPECT_EQ(results.overview.processes[0].vpid, 71);
  EXPECT_EQ(results.overview.processes[1].vpid, 71);
  EXPECT_EQ(results.overview.processes[2].vpid, 72);
  ASSERT_EQ(results.ros2.callbacks.size(), 6u);
  for (const CallbackResult& callback : results.ros2.callbacks) {
    EXPECT_EQ(callback.durations.count, 1u);
  }
  EXPECT_EQ(results.ros2.executors.size(), 4u);
}

}  // namespace
}  // namespace tracing
