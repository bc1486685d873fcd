// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/unit/report/example_reports.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/report/recorded_sessions.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(TextReport, OfAnEmptyTraceSaysSo) {
  EXPECT_EQ(text_report({"/traces/run", {}, ""}),
            "Trace      /traces/run\n"
            "Events     0 of 0 processes\n"
            "Losses     no events lost\n");
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

TEST(TextReport, HasNoControlCharactersOfNames) {
  Report report{"/traces/run", {}, ""};
  CallbackResult callback;
  callback.node = "/ping\n\x1b[2J";
  callback.owner = CallbackResult::Owner::kTimer;
  callback.durations = {7, 1'000.0, 0.0, 1'000, 1'000, 1'000, 1'000, 1'000, true};
  report.results.ros2.callbacks = {callback};
  report.results.overview = overview_of(2, {{71, "ping", 1, false, "left"}});
  EXPECT_THAT(text_report(report, {.all = true}),
              ::testing::AllOf(HasSubstr("\n  /ping??[2J, timer"), Not(HasSubstr("\x1b"))));
}

TEST(TextReport, ShowsEverythingOnDemand) {
  EXPECT_EQ(text_report(report_with_results(), {.all = true}),
            R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     10 of 1 process
Losses     no events lost

Worth a look
  Rare slowness     /ns/node, subscription /camera/front/image_raw/compressed
                    usually takes 1.40 us, at p99 3.00 us, at most 99.0 ms
  No response       /add: 1 of 2 requests from /ns/node got no response

Callbacks                             rate  count      p50      p99      max  jitter  missed    load
  /ns/node, subscr..e_raw/compressed     -  70000  1.40 us  3.00 us  99.0 ms       -       -  5.25 %
  /ns/node, client of /add               -      1  1.00 us  1.00 us  1.00 us       -       -  0.00 %
  callback 0xcb                          -      -        -        -        -       -       -       -

Topics                                rate   sent  received  dropped     p50     p99      max
  /camera/front/image_raw/compressed     -  70010     70001        -  140 us  300 us  1.00 ms

Services                   calls  unanswered      p50      p99      max
  /add, asked by /ns/node      2           1  3.00 us  3.00 us  3.00 us

Events by process                              total  ping [71]

Start of processes                       spawn  rcl_init  first node     ready    callback     message
  ping-1 [71]                                -         -     12.0 ms   20.0 ms           -           -
  sh-2 [72]                                  -         -           -         -           -           -
  (spawn: until exec; all others after exec: ready, an executor looks for work; the first callback; the first
  message that it publishes)

Callbacks                              count    mean  stddev     min     p50     p90     p99     max
node unknown, ping [71]
  callback 0xcb                            0
    1 more without an end
/ns/node, ping [71]
  subscription /camera/front/image_raw/compressed
                                       70000 1.50 us  250 ns 1.00 us 1.40 us 2.00 us 3.00 us 99.0 ms
    Node::on_image(Image const&)
    5 of them intra-process
  client of /add                           1 1.00 us       - 1.00 us 1.00 us 1.00 us 1.00 us 1.00 us

Topics                  published received  untaken    mean     min     p50     p90     p99     max
  /camera/front/image_raw/compressed
                            70010    70001       10  150 us  100 us  140 us  200 us  300 us 1.00 ms
    1 of those received were published outside the trace
  (times: from rmw_publish to callback_start; untaken: by any subscription in the trace)
  (1 topic without messages)

Services                               count    mean  stddev     min     p50     p90     p99     max
/add, /ns/node asks unknown
  round trip                               1 3.00 us       - 3.00 us 3.00 us 3.00 us 3.00 us 3.00 us
    way to the service                     0
    in the service                         0
    way back                               0
    1 request without a response
  (from rmw_send_request to rmw_take_response; in the service: from rmw_take_request on)

Served by executors                    count    mean  stddev     min     p50     p90     p99     max
/ns/node, ping [71]
  client of /add                           2 2.00 us       - 2.00 us 2.00 us 2.00 us 2.00 us 2.00 us
node unknown, ping [71]
  waitable 0xabc                           7
  (until the response is sent, or the client's callback has ended)

Notes
  The session had no context vpid or vtid: processes and threads can't be told apart.
  4 messages of publishers or subscriptions whose creation is not in the trace: was it started late?
  ros2:rmw_publish has no field timestamp (recorded by another version of ros2_tracing?)
)");
}

TEST(TextReport, FitsTheWidth) {
  for (const std::size_t width : {60U, 80U, 100U, 200U}) {
    for (const bool compact : {false, true}) {
      std::istringstream lines(text_report(report_with_results(), {.width = width, .compact = compact}));
      for (std::string line; std::getline(lines, line);) {
        if (line == "Notes") {
          break;
        }
        EXPECT_LE(line.size(), width) << line;
      }
    }
  }
}

TEST(TextReport, HasColorsIfTheTerminalHas) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(412, {{71, "ping", 412, false}});
  EXPECT_THAT(text_report(report, {.color = true}), HasSubstr("Losses     \033[32mno events lost\033[0m\n"));
  EXPECT_THAT(text_report(report), Not(HasSubstr("\033")));
}

TEST(TextReport, SortsAndChooses) {
  const auto first_words = [](const ReportOptions& options) {
    std::istringstream lines(text_report(busy_report(), options));
    std::string found;
    bool in_table = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("Callbacks")) {
        in_table = true;
      } else if (line.empty()) {
        in_table = false;
      } else if (in_table) {
        found += line.substr(2, line.find(',') - 2) + " ";
      }
    }
    return found;
  };
  EXPECT_EQ(first_words({}), "/slow /often /rare ");
  EXPECT_EQ(first_words({.top = 2}), "/slow /often ");
  EXPECT_EQ(first_words({.top = 0}), "/slow /often /rare ");
  EXPECT_EQ(first_words({.sort = "count"}), "/often /slow /rare ");
  EXPECT_EQ(first_words({.sort = "max"}), "/rare /slow /often ");
  EXPECT_EQ(first_words({.sort = "name"}), "/often /rare /slow ");
  EXPECT_EQ(first_words({.node = "/[or]*"}), "/often /rare ");
  EXPECT_EQ(first_words({.topic = "/scan"}), "/often ");
  EXPECT_EQ(first_words({.topic = "/none"}), "");
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

TEST(TextReport, FollowsTheChosenChain) {
  EXPECT_EQ(text_report(busy_report(), {.chain = {"/slow", "/often"}}), R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     50000 of 2 processes
Losses     no events lost

Chains                           count      p50      p99      max  reaction p99  age max
  /slow -> /often  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms

Step by step                           count    mean  stddev     min     p50     p90     p99     max
  /slow, timer 100 ms
    until it publishes                    20 40.0 ms    0 ns 40.0 ms 40.0 ms 45.0 ms 45.0 ms 50.0 ms
    /scan on its way                      20  200 us    0 ns  200 us  200 us 3.00 ms 3.00 ms 5.00 ms
  /often, subscription /scan
  response                                20 41.0 ms    0 ns 41.0 ms 41.0 ms 48.0 ms 48.0 ms 55.0 ms
  reaction                                19  141 ms    0 ns  141 ms  141 ms  148 ms  148 ms  255 ms
  age                                     20 41.0 ms    0 ns 41.0 ms 41.0 ms 48.0 ms 48.0 ms 55.0 ms
)");
  EXPECT_THAT(text_report(busy_report(), {.chain = {"/often", "/slow"}}),
              HasSubstr("\nNo chain leads from /often to /slow.\n"));
}

TEST(TextReport, SaysWhatIsWorthALook) {
  EXPECT_EQ(text_report(busy_report()), R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     50000 of 2 processes
Losses     no events lost

Worth a look
  Worst jitter      /slow, timer 100 ms: up to 120 ms off its period, at p99 100 ms; 1 period missed
  Busiest executor  /slow [71]: 95 % busy, once for 80.0 ms in /slow, timer 100 ms
  Dropped messages  /scan to /often
                    40 of 2040: 30 pushed out of its queue, 8 lost by the publisher, 2 not executed
  Slowest chain     /slow -> /often: 2 steps take 41.0 ms, at p99 48.0 ms, at most 55.0 ms
  Longest wait      /scan to /often
                    messages wait 100 us for a busy executor, at p99 2.00 ms of 3.00 ms in all

Chains                           count      p50      p99      max  reaction p99  age max
  /slow -> /often  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms

Callbacks                            rate  count      p50      p99      max  jitter  missed     load
  /slow, timer 100 ms              9.5 Hz     20  50.0 ms  60.0 ms  70.0 ms  100 ms       1  50.00 %
  /often, subscription /scan    17.98 kHz   2000  20.0 us  30.0 us  40.0 us       -       -   2.00 %
  /rare, service /reset                 -     10  1.00 ms  2.00 ms  90.0 ms       -       -   0.50 %

Topics      rate  sent  received  dropped     p50      p99      max
  /scan  1020 Hz  2040      2002       40  200 us  3.00 ms  5.00 ms

Executors        busy  callbacks  longest busy                   in
  /slow [71]  95.00 %         20       80.0 ms  /slow, timer 100 ms

Services                  calls  unanswered      p50      p99      max
  /reset, asked by /slow     10           1  2.00 ms  3.00 ms  95.0 ms

Lifecycle nodes  state at the end  time in active  changes
  /rare                    active          1.90 s        1
)");
}

}  // namespace
}  // namespace tracing
