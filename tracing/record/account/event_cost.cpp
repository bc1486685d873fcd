// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/event_cost.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/environment/home_directory.hpp"
#include "base/files/replace_file.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

nlohmann::ordered_json as_json(const EventCost& cost) {
  return {{"ns_per_event", cost.ns_per_event},
          {"cpu", cost.cpu},
          {"lttng", cost.lttng},
          {"context_fields", cost.context_fields},
          {"measured", cost.measured}};
}

// The measurements of this user; a file that can't be understood holds none.
nlohmann::ordered_json read_measurements() {
  std::ifstream file(event_cost_file());
  auto read = nlohmann::ordered_json::parse(file, nullptr, false);
  return read.is_array() ? read : nlohmann::ordered_json::array();
}

bool holds_for(const nlohmann::ordered_json& measured, const std::string& cpu,
               const std::vector<std::string>& context_fields) {
  return measured.is_object() && measured.value("cpu", "") == cpu &&
         measured.value("lttng", "") == LTTNG_VERSION_MEASURED &&
         measured.value("context_fields", std::vector<std::string>()) == context_fields &&
         measured.value("ns_per_event", 0.0) > 0;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string processor_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) {
      continue;
    }
    const std::size_t begin = line.find(": ");
    if (begin != std::string::npos) {
      return line.substr(begin + 2);
    }
  }
  return "unknown processor";
}

fs::path event_cost_file() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return fs::path(cache) / "launch/event_cost.json";
  }
  return fs::path(launch::home_directory()) / ".cache/launch/event_cost.json";
}

std::optional<EventCost> known_event_cost(const std::vector<std::string>& context_fields) {
  const std::string cpu = processor_model();
  const std::vector<std::string> fields = sorted(context_fields);
  for (const nlohmann::ordered_json& measured : read_measurements()) {
    if (!holds_for(measured, cpu, fields)) {
      continue;
    }
    return EventCost{.ns_per_event = measured.at("ns_per_event"),
                     .cpu = cpu,
                     .lttng = LTTNG_VERSION_MEASURED,
                     .context_fields = fields,
                     .measured = measured.value("measured", "")};
  }
  return std::nullopt;
}

void remember(const EventCost& cost) {
  nlohmann::ordered_json kept = nlohmann::ordered_json::array();
  for (const nlohmann::ordered_json& measured : read_measurements()) {
    if (!holds_for(measured, cost.cpu, cost.context_fields)) {
      kept.push_back(measured);
    }
  }
  kept.push_back(as_json(cost));
  const fs::path file = event_cost_file();
  try {
    launch::replace_file(launch::open_or_make_directory(file.parent_path()), file.filename(), kept.dump(2) + "\n");
  } catch (const std::system_error& error) {
    throw TraceError(fmt::format("cannot write {}: {}", file.string(), error.code().message()));
  }
}

}  // namespace tracing
