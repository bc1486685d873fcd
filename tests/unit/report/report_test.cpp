// SPDX-License-Identifier: Apache-2.0
#include "tracing/report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tracing/report/text_table.hpp"

namespace tracing {
namespace {

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

TEST(TextReport, ShowsWhereEventsWereLostAndWhoseResultsAreDoubtful) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(2, {{71, "ping", 1, true}, {72, "pong", 1, true}, {73, "talker", 1, false}});
  report.results.overview.losses = {loss_of(37, 0, false), loss_of(0, 3, false), loss_of(0, 0, true)};
  report.results.overview.losses[2].stream = "/elsewhere/ros2_1";
  report.results.overview.losses[2].begin_ns = std::nullopt;
  EXPECT_EQ(text_report(report),
            R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     2 of 3 processes
Losses     at least 37 events and 3 packets lost

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
  EXPECT_EQ(text_report(report),
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
  EXPECT_EQ(text_report(report),
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
  callback.vpid = 71;
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
  call.client_vpid = 71;
  call.client = "/ns/node";
  call.requests = 2;
  call.responses = 1;
  call.round_trip = {1, 3'000.0, 0.0, 3'000, 3'000, 3'000, 3'000, 3'000, true};
  report.results.ros2.calls = {call};
  ExecutionResult served;
  served.vpid = 71;
  served.kind = ExecutionResult::Kind::kClient;
  served.node = "/ns/node";
  served.service = "/add";
  served.count = 2;
  served.durations = {1, 2'000.0, 0.0, 2'000, 2'000, 2'000, 2'000, 2'000, true};
  ExecutionResult waitable;
  waitable.vpid = 71;
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

TEST(TextReport, ShowsCallbacksTopicsAndNotes) {
  EXPECT_EQ(text_report(report_with_results()),
            R"(Trace      /traces/run
Recorded   2026-01-01 00:00:00.000000 UTC, for 2.00 s
Events     10 of 1 process
Losses     no events lost

Events by process                              total  ping [71]

Start of processes                                        first node       ready
  ping-1 [71]                                                12.0 ms     20.0 ms
  sh-2 [72]                                                        -           -
  (after exec; ready: an executor looks for work)

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
  Percentiles of more than 65536 values are estimates from a random sample.
  ros2:rmw_publish has no field timestamp (recorded by another version of ros2_tracing?)
)");
}

TEST(TextReport, FitsTheWidth) {
  std::istringstream lines(text_report(report_with_results()));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), kReportWidth) << line;
}

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
            nlohmann::json::parse(R"json([{"vpid":71,"name":"ping","events":10,"doubtful":false}])json"));
  EXPECT_EQ(json["losses"], nlohmann::json::parse(R"json([{"stream":"/traces/run/ust/uid/0/64-bit/ros2_0","events":37,
      "packets":3,"uncounted":true,"begin_ns":1767225600500000000,"end_ns":1767225601500000000,
      "processes":[0]}])json"));
  EXPECT_EQ(json["callbacks"][0],
            nlohmann::json::parse(R"json({"vpid":71,"node":"","owner":"unknown","address":203,"symbol":"",
      "duration":{"count":0},"intra_process":0,"unfinished":1})json"));
  EXPECT_EQ(json["callbacks"][1], nlohmann::json::parse(R"json({"vpid":71,"node":"/ns/node","owner":"subscription",
      "topic":"/camera/front/image_raw/compressed","address":203,"symbol":"Node::on_image(Image const&)",
      "duration":{"count":70000,"mean_ns":1500.0,"stddev_ns":250.0,"min_ns":1000,"p50_ns":1400,"p90_ns":2000,
      "p99_ns":3000,"max_ns":99000000,"percentiles_are_exact":false},"intra_process":5,"unfinished":0})json"));
  EXPECT_EQ(json["starts"][0], nlohmann::json::parse(R"json({"vpid":71,"process":"ping-1","file":"a.launch.xml",
      "line":3,"exec_ns":1767225600000000000,"node_after_ns":12000000,"ready_after_ns":20000000})json"));
  EXPECT_EQ(json["starts"][1]["ready_after_ns"], nullptr);
  EXPECT_EQ(json["callbacks"][2]["owner"], "client");
  EXPECT_EQ(json["callbacks"][2]["service"], "/add");
  EXPECT_EQ(json["calls"][0], nlohmann::json::parse(R"json({"service":"/add","client_vpid":71,"client":"/ns/node",
      "server_vpid":null,"server":"","requests":2,"responses":1,"round_trip":{"count":1,"mean_ns":3000.0,
      "stddev_ns":0.0,"min_ns":3000,"p50_ns":3000,"p90_ns":3000,"p99_ns":3000,"max_ns":3000,
      "percentiles_are_exact":true},"request":{"count":0},"in_service":{"count":0},"response":{"count":0}})json"));
  EXPECT_EQ(json["executions"][0], nlohmann::json::parse(R"json({"vpid":71,"node":"/ns/node","kind":"client",
      "service":"/add","count":2,"duration":{"count":1,"mean_ns":2000.0,"stddev_ns":0.0,"min_ns":2000,"p50_ns":2000,
      "p90_ns":2000,"p99_ns":2000,"max_ns":2000,"percentiles_are_exact":true}})json"));
  EXPECT_EQ(json["executions"][1],
            nlohmann::json::parse(
                R"json({"vpid":71,"node":"","kind":"waitable","address":2748,"count":7,"duration":{"count":0}})json"));
  EXPECT_EQ(json["topics"][0]["published_only"], 10);
  EXPECT_EQ(json["topics"][0]["latency"]["p50_ns"], 140'000);
  EXPECT_EQ(json["topics"][1]["latency"], nlohmann::json::parse(R"json({"count":0})json"));
  EXPECT_EQ(json["unknown_messages"], 4);
  EXPECT_EQ(json["warnings"][0], "ros2:rmw_publish has no field timestamp");
}

TEST(JsonReport, SurvivesNamesThatAreNoUtf8) {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(1, {{71, "\xff\xfe", 1, false}});
  EXPECT_EQ(nlohmann::json::parse(json_report(report))["processes"][0]["events"], 1);
}

}  // namespace
}  // namespace tracing
