// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "tracing/model/analysis/callback_owner_name.hpp"
#include "tracing/model/findings/finding.hpp"
#include "tracing/model/objects/callback_symbol.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json optional(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json durations(const DurationSummary& summary) {
  Json json{{"count", summary.count}};
  if (summary.count == 0) {
    return json;
  }
  json["mean_ns"] = summary.mean_ns;
  json["stddev_ns"] = summary.stddev_ns;
  json["min_ns"] = summary.min_ns;
  json["p50_ns"] = summary.p50_ns;
  json["p90_ns"] = summary.p90_ns;
  json["p99_ns"] = summary.p99_ns;
  json["p999_ns"] = summary.p999_ns;
  json["p9999_ns"] = summary.p9999_ns;
  json["max_ns"] = summary.max_ns;
  json["percentiles_are_exact"] = summary.percentiles_are_exact;
  return json;
}

Json vpid(ProcessIndex process, const TraceOverview& overview) {
  return process < overview.processes.size() ? Json(overview.processes[process].vpid.value_or(0)) : Json(nullptr);
}

Json vpid(const std::optional<ProcessIndex>& process, const TraceOverview& overview) {
  return process ? vpid(*process, overview) : Json(nullptr);
}

Json callback(const CallbackResult& result, const TraceOverview& overview) {
  Json json{{"vpid", vpid(result.process, overview)},
            {"process", result.process},
            {"node", result.node},
            {"owner", owner_name(result.owner)}};
  if (result.owner == CallbackResult::Owner::kSubscription) {
    json["topic"] = result.owner_name;
  }
  const bool of_service =
      result.owner == CallbackResult::Owner::kService || result.owner == CallbackResult::Owner::kClient;
  if (of_service) {
    json["service"] = result.owner_name;
  }
  if (result.owner == CallbackResult::Owner::kTimer) {
    json["period_ns"] = result.period_ns;
  }
  json["address"] = result.address;
  json["symbol"] = result.symbol;
  json["duration"] = durations(result.durations);
  json["intra_process"] = result.intra_process;
  json["unfinished"] = result.unfinished;
  json["rate_hz"] = result.rate_hz;
  json["interval"] = durations(result.interval);
  if (result.owner == CallbackResult::Owner::kTimer) {
    json["jitter"] = durations(result.jitter);
    json["missed"] = result.missed;
    json["overruns"] = result.overruns;
  }
  json["short_symbol"] = short_symbol(result.symbol);
  json["allocations"] = optional(result.allocations);
  json["allocated_bytes"] = result.allocated_bytes;
  if (result.running.count > 0) {
    json["running"] = durations(result.running);
    json["runnable"] = durations(result.runnable);
    json["blocked"] = durations(result.blocked);
    json["longest_runnable_ns"] = result.longest_runnable_ns;
    json["ran_instead"] = result.ran_instead;
  }
  json["doubtful"] = result.doubtful;
  return json;
}

Json topic(const TopicResult& result) {
  return {{"name", result.name},
          {"publishers", result.publishers},
          {"subscriptions", result.subscriptions},
          {"published", result.published},
          {"received", result.received},
          {"published_only", result.published_only},
          {"received_only", result.received_only},
          {"latency", durations(result.latency)},
          {"rate_hz", result.rate_hz},
          {"interval", durations(result.interval)},
          {"intra_process_published", result.intra_process_published},
          {"intra_process_received", result.intra_process_received},
          {"early", result.early},
          {"earliest_ns", result.earliest_ns},
          {"doubtful", result.doubtful}};
}

Json subscription(const SubscriptionResult& result, const TraceOverview& overview) {
  return {{"vpid", vpid(result.process, overview)},
          {"process", result.process},
          {"node", result.node},
          {"topic", result.topic},
          {"queue_depth", result.queue_depth},
          {"received", result.received},
          {"intra_process", result.intra_process},
          {"delivered", result.delivered},
          {"not_executed", result.not_executed},
          {"overwritten", result.overwritten},
          {"overwritten_in_buffer", result.overwritten_in_buffer},
          {"lost", result.lost},
          {"lost_by_publisher", result.lost_by_publisher},
          {"lost_in_transport", result.lost_in_transport},
          {"before_first", result.before_first},
          {"after_last", result.after_last},
          {"latency", durations(result.latency)},
          {"rclcpp", durations(result.rclcpp)},
          {"rcl", durations(result.rcl)},
          {"transport", durations(result.transport)},
          {"executor", durations(result.executor)},
          {"take", durations(result.take)},
          {"doubtful", result.doubtful}};
}

Json executor(const ExecutorResult& result, const TraceOverview& overview) {
  return {{"vpid", vpid(result.process, overview)},
          {"process", result.process},
          {"vtid", result.vtid},
          {"span_ns", result.span_ns},
          {"callbacks", result.callbacks},
          {"callback_ns", result.callback_ns},
          {"waited_ns", optional(result.waited_ns)},
          {"utilisation", result.utilisation},
          {"longest_busy_ns", result.longest_busy_ns},
          {"longest_busy_begin_ns", result.longest_busy_begin_ns},
          {"longest_callback", result.longest_callback},
          {"doubtful", result.doubtful}};
}

Json chain(const ChainResult& result, const TraceOverview& overview) {
  Json steps = Json::array();
  for (const ChainResult::Step& step : result.steps) {
    Json json{{"vpid", vpid(step.process, overview)},
              {"process", step.process},
              {"node", step.node},
              {"callback", step.callback}};
    if (!step.topic.empty()) {
      json["topic"] = step.topic;
      json["until_publish"] = durations(step.until_publish);
      json["transfer"] = durations(step.transfer);
      json["executor"] = durations(step.executor);
      json["take"] = durations(step.take);
    }
    steps.push_back(std::move(json));
  }
  return {{"name", result.name},
          {"steps", std::move(steps)},
          {"budget_ns", optional(result.budget_ns)},
          {"over_budget", result.over_budget},
          {"last_callback", durations(result.last_callback)},
          {"response", durations(result.response)},
          {"reaction", durations(result.reaction)},
          {"age", durations(result.age)},
          {"longest_begin_ns", result.longest_begin_ns},
          {"longest_end_ns", result.longest_end_ns},
          {"is_loop", result.is_loop},
          {"doubtful", result.doubtful}};
}

Json lifecycle_state(const LifecycleResult& result, const TraceOverview& overview) {
  return {{"vpid", vpid(result.process, overview)},
          {"process", result.process},
          {"node", result.node},
          {"state", result.state},
          {"begin_ns", result.begin_ns},
          {"end_ns", result.end_ns},
          {"ended", result.ended},
          {"allocations", optional(result.allocations)},
          {"allocated_bytes", result.allocated_bytes},
          {"process_allocations", result.process_allocations},
          {"process_allocated_bytes", result.process_allocated_bytes}};
}

Json unmatched_events(const UnmatchedResult& result) {
  return {{"event", result.event}, {"reason", result.reason}, {"count", result.count}};
}

Json call(const CallResult& result, const TraceOverview& overview) {
  return {{"service", result.service},
          {"client_vpid", vpid(result.client_process, overview)},
          {"client_process", optional(result.client_process)},
          {"client", result.client},
          {"server_vpid", vpid(result.server_process, overview)},
          {"server_process", optional(result.server_process)},
          {"server", result.server},
          {"requests", result.requests},
          {"responses", result.responses},
          {"round_trip", durations(result.round_trip)},
          {"request", durations(result.request)},
          {"in_service", durations(result.in_service)},
          {"response", durations(result.response)}};
}

Json execution(const ExecutionResult& result, const TraceOverview& overview) {
  Json json{{"vpid", vpid(result.process, overview)}, {"process", result.process}, {"node", result.node}};
  switch (result.kind) {
    case ExecutionResult::Kind::kService:
    case ExecutionResult::Kind::kClient:
      json["kind"] = result.kind == ExecutionResult::Kind::kService ? "service" : "client";
      json["service"] = result.service;
      break;
    case ExecutionResult::Kind::kWaitable:
      json["kind"] = "waitable";
      json["address"] = result.address;
      break;
  }
  json["count"] = result.count;
  json["duration"] = durations(result.durations);
  return json;
}

Json processes(const TraceOverview& overview) {
  Json list = Json::array();
  for (const ProcessResult& process : overview.processes) {
    list.push_back({{"vpid", optional(process.vpid)},
                    {"name", process.name},
                    {"host", process.host},
                    {"events", process.events},
                    {"doubtful", process.doubtful}});
  }
  return list;
}

Json event_counts(const TraceOverview& overview) {
  Json list = Json::array();
  for (const EventCount& count : overview.event_counts) {
    list.push_back({{"name", count.name}, {"total", count.total}, {"by_process", count.by_process}});
  }
  return list;
}

Json findings(const TraceResults& results) {
  Json list = Json::array();
  for (const Finding& finding : find_worth_a_look(results)) {
    list.push_back({{"kind", name_of(finding.kind)},
                    {"weight", finding.weight},
                    {"subject", finding.subject},
                    {"figures", finding.figures}});
  }
  return list;
}

Json process_starts(const std::vector<StartResult>& starts) {
  Json list = Json::array();
  for (const StartResult& start : starts) {
    list.push_back({{"vpid", start.vpid},
                    {"process", start.process},
                    {"file", start.file},
                    {"line", start.line},
                    {"exec_ns", start.exec_ns},
                    {"node_after_ns", optional(start.node_after_ns)},
                    {"ready_after_ns", optional(start.ready_after_ns)},
                    {"spawn_ns", optional(start.spawn_ns)},
                    {"init_after_ns", optional(start.init_after_ns)},
                    {"callback_after_ns", optional(start.callback_after_ns)},
                    {"publication_after_ns", optional(start.publication_after_ns)}});
  }
  return list;
}

Json startup(const std::optional<StartupResult>& result) {
  if (!result) {
    return nullptr;
  }
  Json path = Json::array();
  for (const StartStep& step : result->critical_path) {
    path.push_back(
        {{"process", step.process}, {"what", step.what}, {"begin_ns", step.begin_ns}, {"end_ns", step.end_ns}});
  }
  return {{"begin_ns", result->begin_ns}, {"ready_ns", result->ready_ns}, {"critical_path", std::move(path)}};
}

Json cost(const Report& report) {
  if (!report.verdict.ns_per_event) {
    return nullptr;
  }
  Json processes = Json::array();
  for (const RecordedVerdict::ProcessCost& process : report.verdict.processes) {
    processes.push_back({{"name", process.name},
                         {"vpid", process.vpid},
                         {"events", process.events},
                         {"seconds", process.seconds},
                         {"processor_share", process.processor_share},
                         {"ns_per_callback", optional(process.ns_per_callback)}});
  }
  return {{"ns_per_event", *report.verdict.ns_per_event}, {"processes", std::move(processes)}};
}

Json action(const ActionResult& result, const TraceOverview& overview) {
  return {{"name", result.name},
          {"client_vpid", vpid(result.client_process, overview)},
          {"client_process", optional(result.client_process)},
          {"client", result.client},
          {"server_vpid", vpid(result.server_process, overview)},
          {"server_process", optional(result.server_process)},
          {"server", result.server},
          {"goals", result.goals},
          {"answers", result.answers},
          {"results", result.results},
          {"cancels", result.cancels},
          {"feedback", result.feedback},
          {"acceptance", durations(result.acceptance)},
          {"execution", durations(result.execution)}};
}

Json node(const NodeResult& result, const TraceOverview& overview) {
  return {{"vpid", vpid(result.process, overview)},
          {"process", result.process},
          {"name", result.name},
          {"callbacks", result.callbacks},
          {"callback_ns", result.callback_ns}};
}

Json losses(const TraceOverview& overview) {
  Json list = Json::array();
  for (const LossResult& loss : overview.losses) {
    list.push_back({{"stream", loss.stream},
                    {"events", loss.events},
                    {"packets", loss.packets},
                    {"uncounted", loss.uncounted},
                    {"begin_ns", optional(loss.begin_ns)},
                    {"end_ns", optional(loss.end_ns)},
                    {"processes", loss.processes}});
  }
  return list;
}

Json open_directories(const Report& report) {
  Json list = Json::array();
  for (const std::filesystem::path& directory : report.open) {
    list.push_back(directory.native());
  }
  return list;
}

}  // namespace

std::string json_report(const Report& report) {
  const auto& [overview, starts, startup_result, ros2, warnings] = report.results;
  Json json{{"version", 1},
            {"directory", report.directory.string()},
            {"error", report.error.empty() ? Json(nullptr) : Json(report.error)},
            {"begin_ns", optional(overview.begin_ns)},
            {"end_ns", optional(overview.end_ns)},
            {"events", overview.events},
            {"processes", processes(overview)},
            {"starts", process_starts(starts)},
            {"startup", startup(startup_result)},
            {"cost", cost(report)},
            {"losses", losses(overview)},
            {"absent", report.verdict.absences},
            {"overwritten", report.verdict.overwritten},
            {"open", open_directories(report)},
            {"event_counts", event_counts(overview)},
            {"findings", findings(report.results)},
            {"callbacks", Json::array()},
            {"topics", Json::array()},
            {"calls", Json::array()},
            {"actions", Json::array()},
            {"nodes", Json::array()},
            {"executions", Json::array()},
            {"subscriptions", Json::array()},
            {"executors", Json::array()},
            {"chains", Json::array()},
            {"lifecycle", Json::array()},
            {"unmatched", Json::array()}};
  for (const CallbackResult& result : ros2.callbacks) {
    json["callbacks"].push_back(callback(result, overview));
  }
  for (const TopicResult& result : ros2.topics) {
    json["topics"].push_back(topic(result));
  }
  for (const CallResult& result : ros2.calls) {
    json["calls"].push_back(call(result, overview));
  }
  for (const ActionResult& result : ros2.actions) {
    json["actions"].push_back(action(result, overview));
  }
  for (const NodeResult& result : ros2.nodes) {
    json["nodes"].push_back(node(result, overview));
  }
  for (const ExecutionResult& result : ros2.executions) {
    json["executions"].push_back(execution(result, overview));
  }
  for (const SubscriptionResult& result : ros2.subscriptions) {
    json["subscriptions"].push_back(subscription(result, overview));
  }
  for (const ExecutorResult& result : ros2.executors) {
    json["executors"].push_back(executor(result, overview));
  }
  for (const ChainResult& result : ros2.chains) {
    json["chains"].push_back(chain(result, overview));
  }
  for (const LifecycleResult& result : ros2.lifecycle) {
    json["lifecycle"].push_back(lifecycle_state(result, overview));
  }
  for (const UnmatchedResult& result : ros2.unmatched) {
    json["unmatched"].push_back(unmatched_events(result));
  }
  json["unseen_chains"] = ros2.unseen_chains;
  json["has_all_chains"] = ros2.has_all_chains;
  json["internal_messages"] = ros2.internal_messages;
  json["unknown_messages"] = ros2.unknown_messages;
  json["lacks_thread_context"] = ros2.lacks_thread_context;
  json["warnings"] = warnings;
  // Names in a trace are bytes from the traced program. Bytes that are not UTF-8 must not make the report fail.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace tracing
