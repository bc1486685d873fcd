// SPDX-License-Identifier: Apache-2.0
#include "tracing/session/event_cost.hpp"

#include <fmt/core.h>
#include <lttng/lttng.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tracing/session/channels.hpp"
#include "tracing/session/installed_program.hpp"
#include "tracing/session/lttng_error.hpp"
#include "tracing/session/session_daemon.hpp"
#include "tracing/session/trace_config.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProbe = "launch-trace-probe";
// Small enough that every page has been touched before it counts, and stays in the cache.
constexpr std::uint64_t kSubbufferSize = 65536;  // bytes

// A snapshot session: its events stay in memory.
class CalibrationSession {
 public:
  explicit CalibrationSession(const std::vector<std::string>& context_fields)
      : name_(fmt::format("launch-calibration-{}", getpid())) {
    check_lttng(lttng_create_session_snapshot(name_.c_str(), nullptr),
                "create a session to measure the cost of events");
    try {
      const TraceConfig defaults;
      ChannelPlan plan;
      plan.channel = "calibration";
      plan.events = {{.pattern = "launch_probe:measured"}};
      plan.context_fields = context_fields;
      plan.subbuffer_size = kSubbufferSize;
      plan.subbuffer_count = defaults.subbuffer_count_ust;
      plan.overwrite = true;
      enable_channel(name_, plan);
      enable_events(name_, plan);
      add_contexts(name_, plan);
      check_lttng(lttng_start_tracing(name_.c_str()), "measure the cost of events");
    } catch (const TraceError&) {
      lttng_destroy_session_no_wait(name_.c_str());
      throw;
    }
  }
  ~CalibrationSession() { lttng_destroy_session_no_wait(name_.c_str()); }
  CalibrationSession(const CalibrationSession&) = delete;
  CalibrationSession& operator=(const CalibrationSession&) = delete;

 private:
  std::string name_;
};

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

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm local{};
  localtime_r(&time, &local);
  char text[sizeof "YYYY-MM-DD HH:MM:SS"];
  std::strftime(text, sizeof text, "%F %T", &local);
  return text;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string processor_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t begin = line.find(": ");
    if (begin != std::string::npos) return line.substr(begin + 2);
  }
  return "unknown processor";
}

fs::path event_cost_file() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return fs::path(cache) / "launch/event_cost.json";
  }
  const char* const home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : "/tmp") / ".cache/launch/event_cost.json";
}

std::optional<EventCost> known_event_cost(const std::vector<std::string>& context_fields) {
  const std::string cpu = processor_model();
  const std::vector<std::string> fields = sorted(context_fields);
  for (const nlohmann::ordered_json& measured : read_measurements()) {
    if (!holds_for(measured, cpu, fields)) continue;
    return EventCost{.ns_per_event = measured.at("ns_per_event"),
                     .cpu = cpu,
                     .lttng = LTTNG_VERSION_MEASURED,
                     .context_fields = fields,
                     .measured = measured.value("measured", "")};
  }
  return std::nullopt;
}

EventCost calibrate(const std::vector<std::string>& context_fields) {
  const std::optional<fs::path> probe = installed_program(kProbe);
  if (!probe) throw TraceError("cannot measure the cost of events: launch-trace-probe is not installed");
  ensure_session_daemon();
  const CalibrationSession session(context_fields);
  std::istringstream output(program_output(*probe, {"measure"}));
  double nanoseconds = 0;
  if (!(output >> nanoseconds) || nanoseconds <= 0) {
    throw TraceError("cannot measure the cost of events: launch-trace-probe has recorded none");
  }
  return {.ns_per_event = nanoseconds,
          .cpu = processor_model(),
          .lttng = LTTNG_VERSION_MEASURED,
          .context_fields = sorted(context_fields),
          .measured = now()};
}

void remember(const EventCost& cost) {
  nlohmann::ordered_json kept = nlohmann::ordered_json::array();
  for (const nlohmann::ordered_json& measured : read_measurements()) {
    if (!holds_for(measured, cost.cpu, cost.context_fields)) kept.push_back(measured);
  }
  kept.push_back(as_json(cost));
  const fs::path file = event_cost_file();
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  // In one step, for launches at the same time.
  const fs::path temporary = file.string() + fmt::format(".{}", getpid());
  std::ofstream(temporary) << kept.dump(2) << '\n';
  fs::rename(temporary, file, error);
  if (error) throw TraceError(fmt::format("cannot write {}: {}", file.string(), error.message()));
}

EventCost event_cost(const std::vector<std::string>& context_fields) {
  if (std::optional<EventCost> known = known_event_cost(context_fields)) return *known;
  EventCost measured = calibrate(context_fields);
  try {
    remember(measured);
  } catch (const TraceError&) {
    // A home that can't be written to: it is measured again the next time.
  }
  return measured;
}

std::optional<EventCost> try_event_cost(const std::vector<std::string>& context_fields) {
  try {
    return event_cost(context_fields);
  } catch (const TraceError&) {
    return std::nullopt;
  }
}

}  // namespace tracing
