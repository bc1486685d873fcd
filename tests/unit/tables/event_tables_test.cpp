// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/traced_example/traced_example.hpp"
#include "tests/unit/tables/rows_of.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/timeline/timeline_recorder.hpp"

namespace tracing {
namespace {

using ::testing::ElementsAre;
using testing::rows_of;

TEST(EventTables, HaveEveryHopOfAMessage) {
  const TracedSystem system = testing::traced_example(2);
  const std::vector<std::string> messages =
      rows_of(system, "messages",
              {"rclcpp_ns", "rcl_ns", "published_ns", "written_ns", "taken_ns", "callback_ns", "transport_ns",
               "executor_ns", "intra_process", "estimated"});
  ASSERT_THAT(messages, ::testing::SizeIs(4));
  EXPECT_EQ(messages[0],
            "1767225600020095000|1767225600020097000|1767225600020100000|-|1767225600020250000|1767225600020300000|-|-"
            "|0|0")
      << "no executor has waited yet";
  EXPECT_EQ(messages[2],
            "1767225600030095000|1767225600030097000|1767225600030100000|-|1767225600030250000|1767225600030300000|"
            "148000|2000|0|0");
}

TEST(EventTables, HaveTheWaitsOfExecutors) {
  const TracedSystem system = testing::traced_example(2);
  EXPECT_THAT(rows_of(system, "executor_waits", {"thread", "begin_ns", "end_ns"}),
              ElementsAre("0|1767225600020201000|1767225600029998000", "1|1767225600020701000|1767225600030248000",
                          "2|1767225600020851000|1767225600030748000"));
}

TEST(EventTables, HaveCallsThatNobodyAnswers) {
  timeline::TimelineRecorder recorder;
  TraceAnalysis analysis;
  recorder.record_details(analysis);
  recorder.on_open_call({.client = 1, .service = 0, .sent_ns = 300});
  recorder.on_call(
      {.client = 0, .service = 0, .sent_ns = 100, .taken_ns = 120, .answered_ns = 140, .received_ns = 160});
  recorder.on_open_call({.service = 0, .taken_ns = 200, .answered_ns = 220});
  TracedSystem system;
  system.timeline = recorder.finish(analysis, {});
  EXPECT_THAT(
      rows_of(system, "calls", {"id", "client", "service", "sent_ns", "taken_ns", "answered_ns", "received_ns"}),
      ElementsAre("0|0|0|100|120|140|160", "1|-|0|-|200|220|-", "2|1|0|300|-|-|-"));
}

TEST(EventTables, HaveTheMemoryThatARunOfACallbackAskedFor) {
  timeline::TimelineRecorder recorder;
  TraceAnalysis analysis;
  recorder.record_details(analysis);
  const CallbackInstance outer{.thread = {0, 1}, .callback = 0, .begin_ns = 10, .end_ns = 100};
  const CallbackInstance inner{.thread = {0, 1}, .callback = 1, .begin_ns = 20, .end_ns = 30};
  recorder.on_allocation({{0, 1}, 5, 1'000});  // outside of callbacks
  recorder.on_callback_begin(outer);
  recorder.on_allocation({{0, 1}, 15, 1});
  recorder.on_callback_begin(inner);
  recorder.on_allocation({{0, 1}, 25, 10});
  recorder.on_callback(inner);
  recorder.on_allocation({{0, 1}, 35, 100});
  recorder.on_callback(outer);
  TracedSystem system;
  system.timeline = recorder.finish(analysis, {});
  EXPECT_THAT(rows_of(system, "allocations", {"callback_instance", "allocations", "allocated_bytes"}),
              ElementsAre("0|2|101", "1|1|10"));
}

TEST(EventTables, NeedDetailsForTheirLastColumnsOnly) {
  TracedSystem system = testing::traced_example(1);
  system.timeline.details = {};
  EXPECT_THAT(rows_of(system, "messages", {"id", "rcl_ns", "intra_process", "executor_ns"}),
              ElementsAre("0|-|-|-", "1|-|-|-"));
}

}  // namespace
}  // namespace tracing
