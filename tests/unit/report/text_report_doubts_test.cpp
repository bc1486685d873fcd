// SPDX-License-Identifier: Apache-2.0
// What a report says of itself: what is missing in the trace, and which results that puts in doubt.
#include <gmock/gmock.h>

#include "tests/unit/report/example_reports.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {
namespace {

using ::testing::HasSubstr;

TEST(TextReport, OfAnEmptyTraceSaysSo) {
  EXPECT_EQ(text_report({"/traces/run", {}, ""}),
            "Trace      /traces/run\n"
            "Events     0 of 0 processes\n"
            "Losses     unknown, as nothing tells what was to be recorded\n");
}

TEST(TextReport, DamageThatTheVerdictTellsLeavesLossesUnknown) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(9, {{71, "ping", 9, false}});
  report.verdict.found = report.verdict.damaged = true;
  EXPECT_THAT(text_report(report), HasSubstr("\nLosses     unknown, as a part of the trace is missing\n"));
  EXPECT_THAT(summary_line(report.results.overview, report.verdict), HasSubstr("unknown how many lost"));
}

TEST(TextReport, SaysThatTheTraceIsStillBeingWritten) {
  Report report{"/traces/run", {}, ""};
  report.open = {"/traces/run"};
  report.lacks_descriptions = true;
  EXPECT_EQ(
      text_report(report),
      "Trace      /traces/run\n"
      "Open       still being written; what is complete so far is in this report\n"
      "Events     0 of 0 processes\n"
      "Losses     no events lost\n"
      "\nNotes\n"
      "  Events that LTTng has not described yet are left out; it describes them when a traced program ends or the "
      "session is stopped.\n");
  EXPECT_EQ(nlohmann::json::parse(json_report(report))["open"], nlohmann::json({"/traces/run"}));
}

TEST(TextReport, SaysWhatTheTraceCannotTell) {
  const auto notes_of = [](const Report& report) {
    const std::string text = text_report(report);
    const std::size_t notes = text.find("\nNotes\n");
    return notes == std::string::npos ? "" : text.substr(notes + 7);
  };
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(9, {{71, "ping", 9, false}});
  report.results.overview.event_counts = {{"sched_switch", 9, {9}}};
  EXPECT_EQ(notes_of(report),
            "  The trace has no events of ROS 2, so nothing is known about nodes, callbacks and messages.\n");
  report.results.overview.event_counts = {{"ros2:callback_start", 9, {9}}};
  report.results.ros2.callbacks.resize(1);
  EXPECT_EQ(
      notes_of(report),
      "  The trace has no rcl_node_init: callbacks and messages have no nodes. Were these events recorded, and did "
      "the session begin before the nodes?\n");
  report.results.ros2.nodes = {{0, "/ping", 1, 1}};
  EXPECT_EQ(notes_of(report), "");
  TopicResult topic;
  topic.name = "/scan";
  topic.early = 3;
  topic.earliest_ns = 2'500'000;
  report.results.ros2.topics = {topic};
  EXPECT_EQ(notes_of(report),
            "  3 messages of /scan were taken up to 2.50 ms before they were published: the clocks of two machines "
            "differ, and times between them are wrong.\n");
}

TEST(TextReport, ShowsWhereEventsWereLostAndWhoseResultsAreDoubtful) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(2, {{71, "ping", 1, true}, {72, "pong", 1, true}, {73, "talker", 1, false}});
  report.results.overview.losses = {loss_of(37, 0, false), loss_of(0, 3, false), loss_of(0, 0, true)};
  report.results.overview.losses[2].stream = "/elsewhere/ros2_1";
  report.results.overview.losses[2].begin_ns = std::nullopt;
  EXPECT_EQ(text_report(report, {.events = true}),
            R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     2 of 3 processes
Losses     at least 37 events and 3 packets lost; results marked with * may be wrong

Losses by stream                                            events   packets        from          to
  ust/uid/0/64-bit/ros2_0                                       37         0    +0.500 s    +1.500 s
  ust/uid/0/64-bit/ros2_0                                        0         3    +0.500 s    +1.500 s
  /elsewhere/ros2_1                                           some         0           ?    +1.500 s
  What follows may be incomplete for: ping [71], pong [72]

Events by process                              total  ping [71]  pong [72]  talker [73]
)");
}

TEST(TextReport, MarksWhatLostEventsMayHaveChanged) {
  Report report = busy_report();
  report.results.ros2.callbacks[0].doubtful = true;
  EXPECT_THAT(text_report(report), HasSubstr("\n  /slow, timer 100 ms *"));
}

TEST(TextReport, CountsNoCostOfKernelEvents) {
  Report report = busy_report();
  report.verdict.ns_per_event = 500;
  report.results.overview.events = 3000;
  report.results.overview.event_counts = {{"ros2:rcl_take", 1000, {1000, 0}}, {"sched_switch", 2000, {1000, 1000}}};
  EXPECT_THAT(
      text_report(report),
      HasSubstr("\nCost       500 us of 500 ns for each event, 0.025 % of a processor, without the events of the "
                "kernel\n"));
  report.results.overview.events = 1000;
  report.results.overview.event_counts.pop_back();
  EXPECT_THAT(text_report(report), HasSubstr("\nCost       500 us of 500 ns for each event, 0.025 % of a processor\n"));
  report.results.overview.event_counts = {{"sched_switch", 1000, {1000, 0}}};
  EXPECT_THAT(text_report(report), ::testing::Not(HasSubstr("\nCost ")));
}

}  // namespace
}  // namespace tracing
