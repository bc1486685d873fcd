// SPDX-License-Identifier: Apache-2.0
// Processes, machines and sessions in a report.
#include <gmock/gmock.h>

#include "tests/unit/report/example_reports.hpp"
#include "tracing/show/report/recorded_facts.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(TextReport, PutsProcessesThatDontFitBelow) {
  Report report{"/traces/run", {}, ""};
  report.results.overview.processes = {{100001, "first_component", 1, false},
                                       {100002, "second_componen", 1, false},
                                       {100003, "third_component", 1, false}};
  report.results.overview.events = 6;
  report.results.overview.event_counts = {{"ros2:rcl_take", 6, {1, 2, 3}}};
  EXPECT_EQ(text_report(report, {.events = true}),
            R"(Trace      /traces/run
Events     6 of 3 processes
Losses     no events lost

Events by process                              total  first_component [100001]
  ros2:rcl_take                                    6                         1

Events by process                              total  second_componen [100002]
  ros2:rcl_take                                    6                         2

Events by process                              total  third_component [100003]
  ros2:rcl_take                                    6                         3
)");
}

TEST(TextReport, PutsProcessesThatOnlyTheKernelTellsOfTogether) {
  Report report{"/traces/run", {}, ""};
  report.results.overview.processes = {{0, "swapper/0", 3, false}, {71, "ping", 3, false}, {80, "bash", 4, false}};
  report.results.overview.events = 10;
  report.results.overview.event_counts = {{"ros2:rcl_take", 1, {0, 1, 0}}, {"sched_switch", 9, {3, 2, 4}}};
  EXPECT_EQ(text_report(report, {.events = true}),
            R"(Trace      /traces/run
Events     10 of 3 processes
Losses     no events lost

Events by process                              total  ping [71]  2 of the kernel alone
  ros2:rcl_take                                    1          1                      0
  sched_switch                                     9          2                      7
)");
}

TEST(TextReport, NamesTheMachineInRowsIfThereAreSeveral) {
  Report report{"/traces/run", {}, ""};
  CallbackResult callback;
  callback.node = "/ping";
  callback.owner = CallbackResult::Owner::kTimer;
  callback.period_ns = 10'000'000;
  callback.durations = {7, 1'000.0, 0.0, 1'000, 1'000, 1'000, 1'000, 1'000, true};
  ExecutorResult executor;
  executor.vtid = 71;
  executor.callbacks = 7;
  ChainResult chain;
  chain.name = "reaction";
  chain.steps.resize(3);
  chain.steps[0].node = "/ping";
  chain.steps[1].node = "/ping";
  chain.steps[2].node = "/pong";
  chain.steps[2].process = 1;
  LifecycleResult state;
  state.node = "/ping";
  state.state = "active";
  for (const std::size_t process : {0, 1}) {
    callback.process = executor.process = state.process = process;
    report.results.ros2.callbacks.push_back(callback);
    report.results.ros2.executors.push_back(executor);
    report.results.ros2.lifecycle.push_back(state);
    report.results.ros2.nodes.push_back({process, "/ping", 7, 7'000});
  }
  CallResult call;
  call.service = "/add";
  call.client = "/ping";
  call.client_process = 1;
  call.requests = 1;
  report.results.ros2.calls = {call};
  report.results.ros2.chains = {chain};
  report.results.overview = overview_of(2, {{71, "ping", 1, false, "left"}, {71, "ping", 1, false, "right"}});
  const std::string text = text_report(report);
  for (const char* row : {"left: /ping, timer 10 ms", "right: /ping, timer 10 ms", "left: /ping [71]",
                          "right: /ping [71]", "left -> right: reaction: /ping -> /ping -> /pong",
                          "/add, asked by right: /ping", "\n  left: /ping  ", "\n  right: /ping  "}) {
    EXPECT_THAT(text, HasSubstr(row));
  }
  const std::string all = text_report(report, {.all = true});
  for (const char* row :
       {"\n  left: /ping, ping [71] ", "\nright: /ping, ping [71]\n  timer 10 ms", "\n  right: /pong, ",
        "left: ping [71]  right: ping [71]", "/add, right: /ping asks unknown"}) {
    EXPECT_THAT(all, HasSubstr(row));
  }
  report.results.overview.processes[1].host = "left";
  EXPECT_THAT(text_report(report), Not(HasSubstr("left")));
}

TEST(TextReport, SaysThatSeveralSessionsAreReadAsOne) {
  Report report{"/traces", {}, ""};
  report.results.overview = overview_of(2, {{71, "ping", 1, false, "left"}});
  EXPECT_THAT(text_report(report), Not(HasSubstr("sessions")));
  report.sessions = {"monday", "tuesday"};
  EXPECT_THAT(text_report(report),
              HasSubstr("\n  2 sessions of one machine are read as one, from the first event to the last: monday, "
                        "tuesday. Loads count the time between them, too.\n"));
}

TEST(SeveralSessions, AreOnesOfOneMachineOfDifferentNamesOrTimes) {
  const auto trace = [](const char* host, const char* name, const char* time) {
    TraceDescription description;
    description.environment = {{"hostname", host}, {"trace_name", name}, {"trace_creation_datetime", time}};
    return description;
  };
  EXPECT_THAT(several_sessions({trace("left", "run", "1"), trace("right", "run", "1")}), IsEmpty());
  EXPECT_THAT(several_sessions({trace("left", "run-snapshot", "1"), trace("left", "run-runtime", "2")}), IsEmpty());
  EXPECT_THAT(several_sessions({trace("left", "run", "1"), trace("left", "run", "2"), trace("right", "other", "1")}),
              ElementsAre("run", "run"));
}

}  // namespace
}  // namespace tracing
