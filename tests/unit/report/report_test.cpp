// SPDX-License-Identifier: Apache-2.0
#include "tracing/report/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tracing/findings/quantity_text.hpp"

namespace tracing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kBegin = 1'767'225'600'000'000'000;

TraceOverview overview_of(std::uint64_t events, std::vector<ProcessResult> processes) {
  TraceOverview overview;
  overview.events = events;
  overview.begin_ns = kBegin;
  overview.end_ns = kBegin + 2'000'000'000;
  overview.processes = std::move(processes);
  return overview;
}

LossResult loss_of(std::uint64_t events, std::uint64_t packets, bool uncounted) {
  return {"/traces/run/ust/uid/0/64-bit/ros2_0",
          events,
          packets,
          uncounted,
          kBegin + 500'000'000,
          kBegin + 1'500'000'000,
          {0}};
}

TEST(SummaryLine, SaysWhetherEventsWereLost) {
  TraceOverview overview = overview_of(412, {{71, "ping", 200, false}, {72, "pong", 212, false}});
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, none lost");
  overview.losses = {loss_of(37, 0, false)};
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, 37 events lost; doubtful: ping [71]");
  overview.losses = {loss_of(0, 3, false)};
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, 3 packets lost; doubtful: ping [71]");
  overview.losses = {loss_of(37, 0, false), loss_of(0, 1, true)};
  EXPECT_EQ(summary_line(overview),
            "412 events, 2 processes, at least 37 events and 1 packet lost; doubtful: ping [71]");
  overview.losses = {loss_of(0, 0, true)};
  EXPECT_EQ(summary_line(overview), "412 events, 2 processes, some events lost; doubtful: ping [71]");
}

TEST(SummaryLine, SaysWhatTheVerdictKnowsBeyondTheTrace) {
  TraceOverview overview = overview_of(412, {{71, "ping", 200, false}});
  RecordedVerdict verdict{.overwritten = {"900 events overwritten, as asked"}};
  EXPECT_EQ(summary_line(overview, verdict), "412 events, 1 process, none lost, 900 events overwritten, as asked");
  verdict.discarded_events = 12;
  EXPECT_EQ(summary_line(overview, verdict), "412 events, 1 process, 12 events lost, 900 events overwritten, as asked");
  overview.losses = {loss_of(37, 0, false)};
  EXPECT_EQ(summary_line(overview, verdict),
            "412 events, 1 process, 37 events lost, 900 events overwritten, as asked; doubtful: ping [71]");
}

TEST(SummaryLine, KnowsOneAndNone) {
  EXPECT_EQ(summary_line(overview_of(1, {{71, "ping", 1, false}})), "1 event, 1 process, none lost");
  EXPECT_EQ(summary_line(TraceOverview()), "no events");
}

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

Report report_with_results() {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(10, {{71, "ping", 10, false}});
  CallbackResult callback;
  callback.address = 0xcb;
  callback.unfinished = 1;
  CallbackResult subscription = callback;
  subscription.node = "/ns/node";
  subscription.owner = CallbackResult::Owner::kSubscription;
  subscription.owner_name = "/camera/front/image_raw/compressed";
  subscription.symbol = "Node::on_image(Image const&)";
  subscription.durations = {70'000, 1'500.0, 250.0, 1'000, 99'000'000, 1'400, 2'000, 3'000, false};
  subscription.intra_process = 5;
  subscription.unfinished = 0;
  report.results.starts = {{71, "ping-1", "a.launch.xml", 3, kBegin, 12'000'000, 20'000'000},
                           {72, "sh-2", "a.launch.xml", 4, kBegin, std::nullopt, std::nullopt}};
  report.results.ros2.callbacks = {callback, subscription};
  CallbackResult client = callback;
  client.node = "/ns/node";
  client.owner = CallbackResult::Owner::kClient;
  client.owner_name = "/add";
  client.durations = {1, 1'000.0, 0.0, 1'000, 1'000, 1'000, 1'000, 1'000, true};
  client.unfinished = 0;
  report.results.ros2.callbacks.push_back(client);
  CallResult call;
  call.service = "/add";
  call.client_process = 0;
  call.client = "/ns/node";
  call.requests = 2;
  call.responses = 1;
  call.round_trip = {1, 3'000.0, 0.0, 3'000, 3'000, 3'000, 3'000, 3'000, true};
  report.results.ros2.calls = {call};
  ExecutionResult served;
  served.kind = ExecutionResult::Kind::kClient;
  served.node = "/ns/node";
  served.service = "/add";
  served.count = 2;
  served.durations = {1, 2'000.0, 0.0, 2'000, 2'000, 2'000, 2'000, 2'000, true};
  ExecutionResult waitable;
  waitable.kind = ExecutionResult::Kind::kWaitable;
  waitable.address = 0xabc;
  waitable.count = 7;
  report.results.ros2.executions = {served, waitable};
  TopicResult topic;
  topic.name = "/camera/front/image_raw/compressed";
  topic.published = 70'010;
  topic.received = 70'001;
  topic.published_only = 10;
  topic.received_only = 1;
  topic.latency = {70'000, 150'000.0, 1'000.0, 100'000, 999'999, 140'000, 200'000, 300'000, true};
  TopicResult silent;
  silent.name = "/rosout";
  report.results.ros2.topics = {topic, silent};
  report.results.ros2.unknown_messages = 4;
  report.results.ros2.lacks_thread_context = true;
  report.results.warnings = {"ros2:rmw_publish has no field timestamp"};
  return report;
}

DurationSummary took(std::uint64_t count, std::int64_t p50_ns, std::int64_t p99_ns, std::int64_t max_ns) {
  DurationSummary summary;
  summary.count = count;
  summary.mean_ns = static_cast<double>(p50_ns);
  summary.min_ns = summary.p50_ns = p50_ns;
  summary.p90_ns = summary.p99_ns = p99_ns;
  summary.max_ns = max_ns;
  return summary;
}

constexpr std::int64_t kMs = 1'000'000;

// Of a trace in which something is wrong everywhere.
Report busy_report() {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(50'000, {{71, "first_component", 40'000, false}, {72, "b", 10'000, false}});
  Ros2Results& ros2 = report.results.ros2;

  CallbackResult slow;
  slow.node = "/slow";
  slow.owner = CallbackResult::Owner::kTimer;
  slow.period_ns = 100 * kMs;
  slow.symbol = "robot::Slow::on_timer()";
  slow.durations = took(20, 50 * kMs, 60 * kMs, 70 * kMs);
  slow.rate_hz = 9.5;
  slow.jitter = took(19, 10 * kMs, 100 * kMs, 120 * kMs);
  slow.missed = 1;
  CallbackResult often;
  often.process = 1;
  often.node = "/often";
  often.owner = CallbackResult::Owner::kSubscription;
  often.owner_name = "/scan";
  often.durations = took(2'000, 20'000, 30'000, 40'000);
  often.rate_hz = 1'000;
  CallbackResult rare;
  rare.process = 1;
  rare.node = "/rare";
  rare.owner = CallbackResult::Owner::kService;
  rare.owner_name = "/reset";
  rare.durations = took(10, 1'000'000, 2'000'000, 90 * kMs);
  ros2.callbacks = {slow, often, rare};

  TopicResult scan;
  scan.name = "/scan";
  scan.published = 2'040;
  scan.received = 2'002;
  scan.rate_hz = 1'020;
  scan.latency = took(2'000, 200'000, 3 * kMs, 5 * kMs);
  ros2.topics = {scan};
  SubscriptionResult subscription;
  subscription.process = 1;
  subscription.node = "/often";
  subscription.topic = "/scan";
  subscription.received = 2'002;
  subscription.delivered = 2'000;
  subscription.not_executed = 2;
  subscription.overwritten = 30;
  subscription.lost = 8;
  subscription.latency = took(2'000, 200'000, 3 * kMs, 5 * kMs);
  subscription.executor = took(2'000, 100'000, 2 * kMs, 4 * kMs);
  ros2.subscriptions = {subscription};

  ExecutorResult executor;
  executor.vtid = 71;
  executor.span_ns = 2'000 * kMs;
  executor.callbacks = 20;
  executor.utilisation = 0.95;
  executor.longest_busy_ns = 80 * kMs;
  executor.longest_callback = "/slow, timer 100 ms";
  ros2.executors = {executor};

  ChainResult chain;
  chain.steps.resize(2);
  chain.steps[0].node = "/slow";
  chain.steps[0].callback = "timer 100 ms";
  chain.steps[1].node = "/often";
  chain.steps[1].callback = "subscription /scan";
  chain.steps[1].topic = "/scan";
  chain.steps[1].until_publish = took(20, 40 * kMs, 45 * kMs, 50 * kMs);
  chain.steps[1].transfer = took(20, 200'000, 3 * kMs, 5 * kMs);
  chain.response = took(20, 41 * kMs, 48 * kMs, 55 * kMs);
  chain.reaction = took(19, 141 * kMs, 148 * kMs, 255 * kMs);
  chain.age = took(20, 41 * kMs, 48 * kMs, 55 * kMs);
  ros2.chains = {chain};

  CallResult call;
  call.service = "/reset";
  call.client = "/slow";
  call.server = "/rare";
  call.requests = 10;
  call.responses = 9;
  call.round_trip = took(9, 2 * kMs, 3 * kMs, 95 * kMs);
  ros2.calls = {call};
  ros2.lifecycle = {{1, "/rare", "unconfigured", kBegin, kBegin + 100 * kMs, true},
                    {1, "/rare", "active", kBegin + 100 * kMs, kBegin + 2'000 * kMs, false}};
  return report;
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
        if (line == "Notes") break;
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
      if (line.starts_with("Callbacks"))
        in_table = true;
      else if (line.empty())
        in_table = false;
      else if (in_table)
        found += line.substr(2, line.find(',') - 2) + " ";
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

TEST(TextReport, FollowsTheChosenChain) {
  EXPECT_EQ(text_report(busy_report(), {.chain = {"/slow", "/often"}}), R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     50000 of 2 processes
Losses     no events lost

Chains                           count      p50      p99      max  reaction p99  age max
  /slow -> /often  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms

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
                    40 of 2040: 30 pushed out of its queue, 8 lost on the way, 2 not executed
  Slowest chain     /slow -> /often: 2 steps take 41.0 ms, at p99 48.0 ms, at most 55.0 ms
  Longest wait      /scan to /often
                    messages wait 100 us for a busy executor, at p99 2.00 ms of 3.00 ms in all

Chains                           count      p50      p99      max  reaction p99  age max
  /slow -> /often  timer 100 ms     20  41.0 ms  48.0 ms  55.0 ms        148 ms  55.0 ms

Callbacks                            rate  count      p50      p99      max  jitter  missed     load
  /slow, timer 100 ms              9.5 Hz     20  50.0 ms  60.0 ms  70.0 ms  100 ms       1  50.00 %
  /often, subscription /scan      1000 Hz   2000  20.0 us  30.0 us  40.0 us       -       -   2.00 %
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

// The entry with the keys of `like` only.
nlohmann::json part(const nlohmann::json& entry, const nlohmann::json& like) {
  nlohmann::json kept;
  for (const auto& [key, value] : like.items()) {
    if (!entry.contains(key)) continue;
    kept[key] = value.is_object() ? part(entry[key], value) : entry[key];
  }
  return kept;
}

#define EXPECT_HOLDS(entry, text)                          \
  do {                                                     \
    const auto expected = nlohmann::json::parse(text);     \
    EXPECT_EQ(part(entry, expected), expected) << (entry); \
  } while (false)

TEST(JsonReport, HoldsEverything) {
  Report report = report_with_results();
  report.error = "damaged";
  report.results.overview.losses = {loss_of(37, 3, true)};
  const auto json = nlohmann::json::parse(json_report(report));
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["directory"], "/traces/run");
  EXPECT_EQ(json["error"], "damaged");
  EXPECT_EQ(json["begin_ns"], kBegin);
  EXPECT_EQ(json["events"], 10);
  EXPECT_EQ(json["processes"],
            nlohmann::json::parse(R"json([{"vpid":71,"name":"ping","host":"","events":10,"doubtful":false}])json"));
  EXPECT_EQ(json["losses"], nlohmann::json::parse(R"json([{"stream":"/traces/run/ust/uid/0/64-bit/ros2_0","events":37,
      "packets":3,"uncounted":true,"begin_ns":1767225600500000000,"end_ns":1767225601500000000,
      "processes":[0]}])json"));
  EXPECT_HOLDS(json["callbacks"][0],
               R"json({"vpid":71,"process":0,"node":"","owner":"unknown","address":203,"symbol":"",
      "duration":{"count":0},"intra_process":0,"unfinished":1})json");
  EXPECT_HOLDS(json["callbacks"][1], R"json({"vpid":71,"process":0,"node":"/ns/node","owner":"subscription",
      "topic":"/camera/front/image_raw/compressed","address":203,"symbol":"Node::on_image(Image const&)",
      "duration":{"count":70000,"mean_ns":1500.0,"stddev_ns":250.0,"min_ns":1000,"p50_ns":1400,"p90_ns":2000,
      "p99_ns":3000,"max_ns":99000000,"percentiles_are_exact":false},"intra_process":5,"unfinished":0})json");
  EXPECT_HOLDS(json["starts"][0], R"json({"vpid":71,"process":"ping-1","file":"a.launch.xml","line":3,
      "exec_ns":1767225600000000000,"node_after_ns":12000000,"ready_after_ns":20000000,"spawn_ns":null})json");
  EXPECT_EQ(json["starts"][1]["ready_after_ns"], nullptr);
  EXPECT_EQ(json["callbacks"][2]["owner"], "client");
  EXPECT_EQ(json["callbacks"][2]["service"], "/add");
  EXPECT_HOLDS(json["calls"][0], R"json({"service":"/add","client_vpid":71,"client_process":0,"client":"/ns/node",
      "server_vpid":null,"server_process":null,"server":"","requests":2,"responses":1,"round_trip":{"count":1,"mean_ns":3000.0,
      "stddev_ns":0.0,"min_ns":3000,"p50_ns":3000,"p90_ns":3000,"p99_ns":3000,"max_ns":3000,
      "percentiles_are_exact":true},"request":{"count":0},"in_service":{"count":0},"response":{"count":0}})json");
  EXPECT_HOLDS(json["executions"][0], R"json({"vpid":71,"process":0,"node":"/ns/node","kind":"client",
      "service":"/add","count":2,"duration":{"count":1,"mean_ns":2000.0,"stddev_ns":0.0,"min_ns":2000,"p50_ns":2000,
      "p90_ns":2000,"p99_ns":2000,"max_ns":2000,"percentiles_are_exact":true}})json");
  EXPECT_EQ(
      json["executions"][1],
      nlohmann::json::parse(
          R"json({"vpid":71,"process":0,"node":"","kind":"waitable","address":2748,"count":7,"duration":{"count":0}})json"));
  EXPECT_EQ(json["topics"][0]["published_only"], 10);
  EXPECT_EQ(json["topics"][0]["latency"]["p50_ns"], 140'000);
  EXPECT_EQ(json["topics"][1]["latency"], nlohmann::json::parse(R"json({"count":0})json"));
  EXPECT_HOLDS(json["callbacks"][1], R"json({"short_symbol":"Node::on_image","rate_hz":0.0,"interval":{"count":0},
      "allocations":null,"allocated_bytes":0,"doubtful":false})json");
  EXPECT_EQ(json["unknown_messages"], 4);
  EXPECT_EQ(json["warnings"][0], "ros2:rmw_publish has no field timestamp");
}

TEST(JsonReport, HoldsWaysChainsExecutorsAndStates) {
  const auto json = nlohmann::json::parse(json_report(busy_report()));
  EXPECT_HOLDS(json["callbacks"][0], R"json({"owner":"timer","rate_hz":9.5,"missed":1,"jitter":{"count":19,
      "p50_ns":10000000,"p999_ns":0,"max_ns":120000000},"interval":{"count":0}})json");
  EXPECT_HOLDS(json["subscriptions"][0], R"json({"vpid":72,"process":1,"node":"/often","topic":"/scan",
      "queue_depth":0,"received":2002,"intra_process":0,"delivered":2000,"not_executed":2,"overwritten":30,
      "overwritten_in_buffer":0,"lost":8,"before_first":0,"after_last":0,"latency":{"p99_ns":3000000},
      "rclcpp":{"count":0},"rcl":{"count":0},"transport":{"count":0},"executor":{"p99_ns":2000000},
      "take":{"count":0},"doubtful":false})json");
  EXPECT_HOLDS(json["executors"][0], R"json({"vpid":71,"process":0,"vtid":71,"span_ns":2000000000,"callbacks":20,
      "callback_ns":0,"waited_ns":null,"utilisation":0.95,"longest_busy_ns":80000000,"longest_busy_begin_ns":0,
      "longest_callback":"/slow, timer 100 ms","doubtful":false})json");
  EXPECT_HOLDS(json["chains"][0], R"json({"response":{"count":20},"reaction":{"max_ns":255000000},
      "age":{"count":20},"is_loop":false,"doubtful":false})json");
  EXPECT_HOLDS(json["chains"][0]["steps"][1], R"json({"vpid":71,"process":0,"node":"/often",
      "callback":"subscription /scan","topic":"/scan","until_publish":{"count":20},"transfer":{"count":20}})json");
  EXPECT_FALSE(json["chains"][0]["steps"][0].contains("topic"));
  EXPECT_HOLDS(json["lifecycle"][1], R"json({"vpid":72,"process":1,"node":"/rare","state":"active",
      "begin_ns":1767225600100000000,"end_ns":1767225602000000000,"ended":false,"allocations":null})json");
  EXPECT_EQ(json["has_all_chains"], true);
  EXPECT_HOLDS(json["findings"][0], R"json({"kind":"worst_jitter","subject":"/slow, timer 100 ms",
      "figures":"up to 120 ms off its period, at p99 100 ms; 1 period missed"})json");
}

TEST(JsonReport, SurvivesNamesThatAreNoUtf8) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(1, {{71, "\xff\xfe", 1, false}});
  EXPECT_EQ(nlohmann::json::parse(json_report(report))["processes"][0]["events"], 1);
}

}  // namespace
}  // namespace tracing
