// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/cost_measurement.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <sstream>

#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/installed_program.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

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
      plan.subbuffer_count = defaults.ust.subbuffer_count;
      plan.read_timer = 0;  // nobody reads
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

EventCost calibrate(const std::vector<std::string>& context_fields) {
  const std::optional<fs::path> probe = installed_program(kProbe);
  if (!probe) {
    throw TraceError(
        "cannot measure the cost of events: launch-trace-probe is not installed, because this installation has been "
        "built without tracepoints");
  }
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

EventCost event_cost(const std::vector<std::string>& context_fields) {
  if (std::optional<EventCost> known = known_event_cost(context_fields)) {
    return *known;
  }
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
