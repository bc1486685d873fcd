// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/recorded_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>

#include "tracing/decode/reader/recorded_bytes.hpp"
#include "tracing/decode/reader/recording.hpp"
#include "tracing/model/findings/quantity_text.hpp"

namespace tracing {

namespace {

namespace fs = std::filesystem;

std::string text(const nlohmann::json& json, const char* key) {
  return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

double number(const nlohmann::json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0;
}

void add_processes(const nlohmann::json& verdict, RecordedVerdict& result) {
  if (!verdict.contains("processes") || !verdict["processes"].is_array()) {
    return;
  }
  for (const nlohmann::json& process : verdict["processes"]) {
    if (!process.is_object() || !process.contains("tracing") || !process["tracing"].is_object()) {
      continue;
    }
    const nlohmann::json& cost = process["tracing"];
    RecordedVerdict::ProcessCost added;
    added.name = text(process, "name");
    added.vpid = static_cast<std::int64_t>(number(process, "pid"));
    added.events = static_cast<std::uint64_t>(number(process, "events"));
    added.seconds = number(cost, "seconds");
    added.processor_share = number(cost, "processor_share");
    if (cost.contains("ns_per_callback")) {
      added.ns_per_callback = number(cost, "ns_per_callback");
    }
    result.processes.push_back(std::move(added));
  }
}

// What the files of limited size have overwritten, or somebody has removed.
void add_overwritten(const nlohmann::json& verdict, RecordedVerdict& result) {
  if (!verdict.contains("channels") || !verdict["channels"].is_array()) {
    return;
  }
  for (const nlohmann::json& channel : verdict["channels"]) {
    if (!channel.is_object() || !channel.contains("before_first_packet")) {
      continue;
    }
    const nlohmann::json& before = channel["before_first_packet"];
    if (!before.is_object()) {
      continue;
    }
    const auto packets = static_cast<std::uint64_t>(number(before, "packets"));
    const std::string why = text(before, "why");
    if (packets == 0) {
      continue;
    }
    if (why == "lost") {
      result.lost_packets += packets;
    } else if (why == "removed") {
      result.overwritten.push_back(format_count(packets, "packet") + " cleared or moved away");
    } else if (before.contains("events") && before["events"].is_number()) {
      const bool at_least = before.contains("at_least") && before["at_least"] == true;
      const auto events = static_cast<std::uint64_t>(number(before, "events"));
      result.overwritten.push_back((at_least ? "at least " : "") + format_count(events, "event") +
                                   " overwritten, as asked");
    } else {
      result.overwritten.push_back(format_count(packets, "packet") + " overwritten, as asked");
    }
  }
}

}  // namespace

std::vector<std::string> several_sessions(const std::deque<TraceDescription>& traces) {
  std::map<std::string, std::map<std::string, std::string>> names;  // by host and session
  for (const TraceDescription& trace : traces) {
    const std::string name = std::string(trace.text("trace_name"));
    const Recording recording =
        recording_of({.hostname = std::string(trace.text("hostname")),
                      .trace_name = name,
                      .trace_creation_datetime = std::string(trace.text("trace_creation_datetime"))});
    if (!recording.session.empty()) {
      names[recording.host].emplace(recording.session, name);
    }
  }
  std::vector<std::string> result;
  for (const auto& [host, sessions] : names) {
    if (sessions.size() < 2) {
      continue;
    }
    for (const auto& [session, name] : sessions) {
      result.push_back(name);
    }
  }
  return result;
}

RecordedVerdict read_verdicts(const std::vector<fs::path>& directories) {
  RecordedVerdict result;
  for (const fs::path& file : verdict_files(directories)) {
    std::ifstream stream(file);
    const nlohmann::json verdict = nlohmann::json::parse(stream, nullptr, false);
    if (!verdict.is_object()) {
      continue;
    }
    result.found = true;
    if (verdict.contains("absent") && verdict["absent"].is_array()) {
      for (const nlohmann::json& absence : verdict["absent"]) {
        if (absence.is_string()) {
          result.absences.push_back(absence.get<std::string>());
        }
      }
    }
    if (const std::string damage = text(verdict, "damage"); !damage.empty()) {
      result.absences.push_back(damage);
      result.damaged = true;
    }
    if (verdict.contains("cut_short") && verdict["cut_short"] == true) {
      result.absences.emplace_back("the last events were not waited for");
    }
    // A snapshot loses the older events by design.
    if (!verdict.contains("reasons")) {
      result.discarded_events += static_cast<std::uint64_t>(number(verdict, "discarded_events"));
      result.lost_packets += static_cast<std::uint64_t>(number(verdict, "lost_packets"));
      add_overwritten(verdict, result);
    }
    if (verdict.contains("event_cost") && verdict["event_cost"].is_object()) {
      const double ns = number(verdict["event_cost"], "ns");
      if (ns > 0) {
        result.ns_per_event = std::max(ns, result.ns_per_event.value_or(0));
      }
    }
    add_processes(verdict, result);
  }
  std::stable_sort(result.processes.begin(), result.processes.end(),
                   [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
  return result;
}

}  // namespace tracing
