// SPDX-License-Identifier: Apache-2.0
// Two recordings below one directory whose processes have equal ids: two systems, or one that two sessions record.
#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>
#include <type_traits>
#include <variant>

#include "tests/support/trace_writer/ping_pong_sequence.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;
using testing::TraceWriter;

// `distance`: how far the contexts of the second system are from those of the first one.
TraceResults results_of(const std::filesystem::path& directory, std::uint64_t distance) {
  for (const std::uint8_t identity : {1, 2}) {
    TraceWriter writer(directory / std::to_string(identity), {.identity = identity});
    for (auto [time, thread, event] : testing::ping_pong_sequence()) {
      if (auto* const init = std::get_if<ros2::RclInit>(&event)) {
        init->context_handle += (identity - 1) * distance;
      }
      writer.write(thread.vpid == testing::kPing.vpid ? 0 : 1, time + identity, thread, event);
    }
    writer.finish();
  }
  TraceAnalysis analysis;
  TraceReader(directory).read(analysis);
  return analysis.finish();
}

// A tracepoint hands its event to both sessions, so it is there twice.
TEST(TwoRecordings, OfOneSystemHaveItsProcessesAndEventsOnce) {
  const TemporaryDirectory directory;
  const TraceResults results = results_of(directory.path(), 0);
  EXPECT_EQ(results.overview.events, testing::ping_pong_sequence().size());
  ASSERT_EQ(results.overview.processes.size(), 2u);
  EXPECT_EQ(results.overview.processes[0].vpid, 71);
  EXPECT_EQ(results.overview.processes[1].vpid, 72);
  ASSERT_EQ(results.ros2.callbacks.size(), 3u);
  for (const CallbackResult& callback : results.ros2.callbacks) {
    EXPECT_EQ(callback.durations.count, 1u);
    EXPECT_EQ(callback.unfinished, 0u);
  }
  EXPECT_EQ(results.ros2.executors.size(), 2u);
  EXPECT_EQ(results.ros2.nodes.size(), 2u);
}

TEST(TwoRecordings, WithEqualProcessIdsHaveFourProcesses) {
  const TemporaryDirectory directory;
  const TraceResults results = results_of(directory.path(), std::uint64_t{1} << 40);
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

// With addresses as large as those of real processes.
ros2::AnyEvent with_large_addresses(ros2::AnyEvent event) {
  constexpr std::uint64_t kHeap = 0x550000000000;
  std::visit(
      []<class Struct>(Struct& fields) {
        if constexpr (!std::is_same_v<Struct, std::monostate>) {
          Struct::for_each_field(fields, []<ros2::FieldType type>(std::string_view, auto& member) {
            if constexpr (type == ros2::FieldType::kPointer) {
              member += member == 0 ? 0 : kHeap;
            }
          });
        }
      },
      event);
  return event;
}

// Of two sessions; the second one begins with the first callback, so it has no initialisations. `later_ns`: how far its
// events are behind those of the first one.
TraceResults results_with_late_session(const std::filesystem::path& directory, std::int64_t later_ns) {
  TraceWriter first(directory / "first", {.identity = 1});
  TraceWriter second(directory / "second", {.identity = 2});
  bool is_begun = false;
  for (const auto& [time, thread, small] : testing::ping_pong_sequence()) {
    const ros2::AnyEvent event = with_large_addresses(small);
    const unsigned cpu = thread.vpid == testing::kPing.vpid ? 0 : 1;
    first.write(cpu, time, thread, event);
    is_begun = is_begun || std::holds_alternative<ros2::CallbackStart>(event);
    if (is_begun) {
      second.write(cpu, time + later_ns, thread, event);
    }
  }
  first.finish();
  second.finish();
  TraceAnalysis analysis;
  TraceReader(directory).read(analysis);
  return analysis.finish();
}

TEST(TwoRecordings, OfWhichOneBeginsLateAreJoinedByEventsThatBothHave) {
  const TemporaryDirectory directory;
  const TraceResults results = results_with_late_session(directory.path(), 1);
  ASSERT_EQ(results.overview.processes.size(), 2u);
  EXPECT_GE(results.overview.events, testing::ping_pong_sequence().size());
  EXPECT_LE(results.overview.events, testing::ping_pong_sequence().size() + 6) << "those before the first common one";
  ASSERT_EQ(results.ros2.callbacks.size(), 3u);
  for (const CallbackResult& callback : results.ros2.callbacks) {
    EXPECT_EQ(callback.durations.count, 1u);
    EXPECT_EQ(callback.unfinished, 0u);
  }
  EXPECT_EQ(results.ros2.executors.size(), 2u);
}

TEST(TwoRecordings, OfWhichOneBeginsLateAreNotJoinedByEventsAtDifferentTimes) {
  const TemporaryDirectory directory;
  const TraceResults results = results_with_late_session(directory.path(), 50'000'000);
  ASSERT_EQ(results.overview.processes.size(), 4u);
  EXPECT_EQ(results.ros2.callbacks.size(), 3u);
}

}  // namespace
}  // namespace tracing
