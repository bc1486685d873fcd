// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "tracing/report/report.hpp"

namespace tracing {

namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json optional(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json durations(const DurationSummary& summary) {
  Json json{{"count", summary.count}};
  if (summary.count == 0) return json;
  json["mean_ns"] = summary.mean_ns;
  json["stddev_ns"] = summary.stddev_ns;
  json["min_ns"] = summary.min_ns;
  json["p50_ns"] = summary.p50_ns;
  json["p90_ns"] = summary.p90_ns;
  json["p99_ns"] = summary.p99_ns;
  json["max_ns"] = summary.max_ns;
  json["percentiles_are_exact"] = summary.percentiles_are_exact;
  return json;
}

const char* owner_name(CallbackResult::Owner owner) {
  switch (owner) {
    case CallbackResult::Owner::kSubscription:
      return "subscription";
    case CallbackResult::Owner::kTimer:
      return "timer";
    case CallbackResult::Owner::kService:
      return "service";
    case CallbackResult::Owner::kClient:
      return "client";
    case CallbackResult::Owner::kUnknown:
      return "unknown";
  }
  return "";
}

Json callback(const CallbackResult& result) {
  Json json{{"vpid", result.vpid}, {"node", result.node}, {"owner", owner_name(result.owner)}};
  if (result.owner == CallbackResult::Owner::kSubscription) json["topic"] = result.owner_name;
  const bool of_service =
      result.owner == CallbackResult::Owner::kService || result.owner == CallbackResult::Owner::kClient;
  if (of_service) json["service"] = result.owner_name;
  if (result.owner == CallbackResult::Owner::kTimer) json["period_ns"] = result.period_ns;
  json["address"] = result.address;
  json["symbol"] = result.symbol;
  json["duration"] = durations(result.durations);
  json["intra_process"] = result.intra_process;
  json["unfinished"] = result.unfinished;
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
          {"latency", durations(result.latency)}};
}

Json call(const CallResult& result) {
  return {{"service", result.service},
          {"client_vpid", optional(result.client_vpid)},
          {"client", result.client},
          {"server_vpid", optional(result.server_vpid)},
          {"server", result.server},
          {"requests", result.requests},
          {"responses", result.responses},
          {"round_trip", durations(result.round_trip)},
          {"request", durations(result.request)},
          {"in_service", durations(result.in_service)},
          {"response", durations(result.response)}};
}

Json execution(const ExecutionResult& result) {
  Json json{{"vpid", result.vpid}, {"node", result.node}};
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

Json process_starts(const std::vector<StartResult>& starts) {
  Json list = Json::array();
  for (const StartResult& start : starts) {
    list.push_back({{"vpid", start.vpid},
                    {"process", start.process},
                    {"file", start.file},
                    {"line", start.line},
                    {"exec_ns", start.exec_ns},
                    {"node_after_ns", optional(start.node_after_ns)},
                    {"ready_after_ns", optional(start.ready_after_ns)}});
  }
  return list;
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

}  // namespace

std::string json_report(const Report& report) {
  const auto& [overview, starts, ros2, warnings] = report.results;
  Json json{{"version", 1},
            {"directory", report.directory.string()},
            {"error", report.error.empty() ? Json(nullptr) : Json(report.error)},
            {"begin_ns", optional(overview.begin_ns)},
            {"end_ns", optional(overview.end_ns)},
            {"events", overview.events},
            {"processes", processes(overview)},
            {"starts", process_starts(starts)},
            {"losses", losses(overview)},
            {"event_counts", event_counts(overview)},
            {"callbacks", Json::array()},
            {"topics", Json::array()},
            {"calls", Json::array()},
            {"executions", Json::array()}};
  for (const CallbackResult& result : ros2.callbacks) json["callbacks"].push_back(callback(result));
  for (const TopicResult& result : ros2.topics) json["topics"].push_back(topic(result));
  for (const CallResult& result : ros2.calls) json["calls"].push_back(call(result));
  for (const ExecutionResult& result : ros2.executions) json["executions"].push_back(execution(result));
  json["internal_messages"] = ros2.internal_messages;
  json["unknown_messages"] = ros2.unknown_messages;
  json["lacks_thread_context"] = ros2.lacks_thread_context;
  json["warnings"] = warnings;
  // Names in a trace are bytes from the traced program. Bytes that are not UTF-8 must not make the report fail.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace tracing
