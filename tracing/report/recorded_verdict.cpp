// SPDX-License-Identifier: Apache-2.0
#include "tracing/report/recorded_verdict.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace tracing {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> verdicts_in(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(directory, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->path().filename() == "verdict.json") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

double number(const nlohmann::json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0;
}

void add_processes(const nlohmann::json& verdict, RecordedVerdict& result) {
  if (!verdict.contains("processes") || !verdict["processes"].is_array()) return;
  for (const nlohmann::json& process : verdict["processes"]) {
    if (!process.is_object() || !process.contains("tracing") || !process["tracing"].is_object()) continue;
    const nlohmann::json& cost = process["tracing"];
    RecordedVerdict::ProcessCost added;
    if (process.contains("name") && process["name"].is_string()) added.name = process["name"].get<std::string>();
    added.vpid = static_cast<std::int64_t>(number(process, "pid"));
    added.events = static_cast<std::uint64_t>(number(process, "events"));
    added.seconds = number(cost, "seconds");
    added.processor_share = number(cost, "processor_share");
    if (cost.contains("ns_per_callback")) added.ns_per_callback = number(cost, "ns_per_callback");
    result.processes.push_back(std::move(added));
  }
}

}  // namespace

RecordedVerdict read_verdicts(const std::vector<fs::path>& directories) {
  RecordedVerdict result;
  for (const fs::path& directory : directories) {
    for (const fs::path& file : verdicts_in(directory)) {
      std::ifstream stream(file);
      const nlohmann::json verdict = nlohmann::json::parse(stream, nullptr, false);
      if (!verdict.is_object()) continue;
      if (verdict.contains("absent") && verdict["absent"].is_array()) {
        for (const nlohmann::json& text : verdict["absent"]) {
          if (text.is_string()) result.absences.push_back(text.get<std::string>());
        }
      }
      if (verdict.contains("event_cost") && verdict["event_cost"].is_object()) {
        const double ns = number(verdict["event_cost"], "ns");
        if (ns > 0) result.ns_per_event = std::max(ns, result.ns_per_event.value_or(0));
      }
      add_processes(verdict, result);
    }
  }
  std::stable_sort(result.processes.begin(), result.processes.end(),
                   [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
  return result;
}

}  // namespace tracing
