// SPDX-License-Identifier: Apache-2.0
// Reports that the tests of texts and of JSON share.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tracing/show/report/report.hpp"

namespace tracing {

inline constexpr std::int64_t kBegin = 1'767'225'600'000'000'000;

inline TraceOverview overview_of(std::uint64_t events, std::vector<ProcessResult> processes) {
  TraceOverview overview;
  overview.events = events;
  overview.begin_ns = kBegin;
  overview.end_ns = kBegin + 2'000'000'000;
  overview.processes = std::move(processes);
  return overview;
}

inline LossResult loss_of(std::uint64_t events, std::uint64_t packets, bool uncounted) {
  return {"/traces/run/ust/uid/0/64-bit/ros2_0",
          events,
          packets,
          uncounted,
          kBegin + 500'000'000,
          kBegin + 1'500'000'000,
          {0}};
}

inline Report report_with_results() {
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

inline DurationSummary took(std::uint64_t count, std::int64_t p50_ns, std::int64_t p99_ns, std::int64_t max_ns) {
  DurationSummary summary;
  summary.count = count;
  summary.mean_ns = static_cast<double>(p50_ns);
  summary.min_ns = summary.p50_ns = p50_ns;
  summary.p90_ns = summary.p99_ns = p99_ns;
  summary.max_ns = max_ns;
  return summary;
}

inline constexpr std::int64_t kMs = 1'000'000;

// Of a trace in which something is wrong everywhere.
inline Report busy_report() {
  Report report{"/traces/run", {}, ""};
  report.results.overview = overview_of(50'000, {{71, "first_component", 40'000, false}, {72, "b", 10'000, false}});
  Ros2Results& ros2 = report.results.ros2;

  CallbackResult slow;
  slow.id = 1;
  slow.node = "/slow";
  slow.owner = CallbackResult::Owner::kTimer;
  slow.period_ns = 100 * kMs;
  slow.symbol = "robot::Slow::on_timer()";
  slow.durations = took(20, 50 * kMs, 60 * kMs, 70 * kMs);
  slow.rate_hz = 9.5;
  slow.jitter = took(19, 10 * kMs, 100 * kMs, 120 * kMs);
  slow.missed = 1;
  CallbackResult often;
  often.id = 2;
  often.process = 1;
  often.node = "/often";
  often.owner = CallbackResult::Owner::kSubscription;
  often.owner_name = "/scan";
  often.durations = took(2'000, 20'000, 30'000, 40'000);
  often.rate_hz = 17'980;
  CallbackResult rare;
  rare.id = 3;
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
  subscription.lost_by_publisher = 8;
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

}  // namespace tracing
