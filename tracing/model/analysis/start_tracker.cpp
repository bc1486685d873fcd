// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/start_tracker.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <utility>

#include "tracing/model/analysis/event_fields.hpp"

namespace tracing {

namespace {

// Whether the event comes from lttng-ust's own thread, which reports the living objects when a session starts.
bool is_of_state_dump(const Event& event) {
  return !event.procname || event.procname->ends_with("-ust");
}

}  // namespace

StartTracker::Kind StartTracker::find_kind(const EventClass& event_class) {
  const std::size_t id = event_class.id;
  if (id >= kinds_.size()) {
    kinds_.resize(id + 1, Kind::kUnknown);
  }
  if (kinds_[id] == Kind::kUnknown) {
    const std::string_view name = event_class.name;
    if (name == "launch:exec") {
      kinds_[id] = Kind::kExec;
    } else if (name == "launch:spawn") {
      kinds_[id] = Kind::kSpawn;
    } else if (name == "launch:ready") {
      kinds_[id] = Kind::kCondition;
    } else if (name == "launch:load" || name == "launch:include" || name == "launch:visit") {
      kinds_[id] = Kind::kStep;
    } else if (name == "launch:signal") {
      kinds_[id] = Kind::kSignal;
    } else if (name == "launch:exit" || name == "launch:respawn") {
      kinds_[id] = Kind::kExit;
    } else if (name.starts_with("launch:")) {
      kinds_[id] = Kind::kLaunch;
    } else if (name == "ros2:rcl_init") {
      kinds_[id] = Kind::kInit;
    } else if (name == "ros2:rcl_node_init") {
      kinds_[id] = Kind::kNode;
    } else if (name.starts_with("ros2:rclcpp_executor_")) {
      kinds_[id] = Kind::kExecutor;
    } else {
      kinds_[id] = Kind::kOther;
    }
  }
  return kinds_[id];
}

void StartTracker::on_event(const Event& event, ProcessId id, Kind kind) {
  if (kind <= Kind::kLaunch) {
    on_launcher_event(event, id, kind);
    return;
  }
  if (!event.vpid) {
    return;
  }
  processes_.resize(std::max<std::size_t>(processes_.size(), id + 1));
  Process& process = processes_[id];
  process.is_seen = true;
  if (process.late) {
    process.is_told = true;
    return;
  }
  if (kind == Kind::kInit) {
    if (process.init_ns) {
      return;
    }
    if (is_of_state_dump(event)) {
      process.late = true;
    } else {
      process.init_ns = event.timestamp_ns;
    }
  } else if (kind == Kind::kNode) {
    if (process.node_ns) {
      return;
    }
    if (is_of_state_dump(event)) {
      process.late = true;
    } else {
      process.node_ns = event.timestamp_ns;
    }
  } else if (process.node_ns && !process.executor_ns) {
    process.is_told = true;
    if (*begins_[event.event_class->trace] > *process.node_ns) {
      process.runs_late = true;
    } else {
      process.executor_ns = event.timestamp_ns;
    }
  }
}

void StartTracker::on_launcher_event(const Event& event, ProcessId launcher, Kind kind) {
  const std::int64_t time = number_of(event, "time");
  if (time == 0) {
    return;
  }
  const std::int64_t zero = event.timestamp_ns - time;
  monotonic_zero_ns_ = std::min(monotonic_zero_ns_.value_or(zero), zero);
  events_.add(event, time, launcher);
  switch (kind) {
    case Kind::kSpawn:
      spawned_ = text_of(event, "process");
      spawn_ns_ = time;
      break;
    case Kind::kExec: {
      Start start;
      start.result = {.vpid = number_of(event, "pid"),
                      .process = text_of(event, "process"),
                      .file = text_of(event, "file"),
                      .line = number_of(event, "line"),
                      .exec_ns = time};
      start.result.spawn_ns = std::exchange(spawn_ns_, std::nullopt);
      start.launcher = launcher;
      start.name = std::exchange(spawned_, "");
      starts_.push_back(std::move(start));
      break;
    }
    case Kind::kCondition:
      conditions_.push_back({text_of(event, "process"), text_of(event, "condition"), time});
      break;
    case Kind::kStep: {
      const std::string file = std::filesystem::path(text_of(event, "name")).filename();
      const std::string what(event.name().substr(event.name().find(':') + 1));
      steps_.push_back({file.empty() ? what : what + " " + file, time, time + number_of(event, "duration")});
      break;
    }
    case Kind::kSignal: {
      const std::int64_t signal = number_of(event, "signal");
      if (signal == SIGINT || signal == SIGTERM || signal == SIGKILL) {
        end(launcher, text_of(event, "process"), time);
      }
      break;
    }
    case Kind::kExit:
      end(launcher, text_of(event, "process"), time);
      break;
    default:
      break;
  }
}

void StartTracker::end(ProcessId launcher, const std::string& process, std::int64_t time_ns) {
  const auto found = std::find_if(starts_.rbegin(), starts_.rend(), [&](const Start& start) {
    return start.launcher == launcher && start.result.process == process;
  });
  if (found != starts_.rend() && !found->end_ns) {
    found->end_ns = time_ns;
  }
}

std::vector<std::pair<ProcessId, std::int64_t>> StartTracker::ends(const ProcessTable& processes) const {
  std::vector<std::pair<ProcessId, std::int64_t>> ends;
  for (const Start& start : starts_) {
    const std::optional<ProcessId> process = processes.beside(start.launcher, start.result.vpid);
    if (process && start.end_ns) {
      ends.emplace_back(*process, *start.end_ns + monotonic_zero_ns_.value_or(0));
    }
  }
  return ends;
}

StartResult StartTracker::result_of(const Start& start, const ProcessTable& processes,
                                    const std::vector<std::optional<ProcessIndex>>& places,
                                    const FirstActivity& first) const {
  StartResult result = start.result;
  result.exec_ns += monotonic_zero_ns_.value_or(0);
  if (result.spawn_ns) {
    *result.spawn_ns += monotonic_zero_ns_.value_or(0);
  }
  const std::optional<ProcessId> process = processes.beside(start.launcher, result.vpid);
  if (!process) {
    return result;
  }
  if (*process < places.size()) {
    result.place = places[*process];
  }
  const Process known = *process < processes_.size() ? processes_[*process] : Process();
  if (!known.is_seen || known.late) {
    return result;
  }
  const auto after = [&](const std::optional<std::int64_t>& time) -> std::optional<std::int64_t> {
    if (!time) {
      return std::nullopt;
    }
    return std::max<std::int64_t>(*time - result.exec_ns, 0);
  };
  result.init_after_ns = after(known.init_ns);
  result.node_after_ns = after(known.node_ns);
  result.ready_after_ns = after(known.executor_ns);
  if (known.runs_late) {
    return result;
  }
  const FirstActivityRecord activity = first.of(*process);
  result.callback_after_ns = after(activity.callback_ns);
  result.publication_after_ns = after(activity.publication_ns);
  return result;
}

void StartTracker::finish(const ProcessTable& processes, const std::vector<std::optional<ProcessIndex>>& places,
                          const FirstActivity& first, TraceResults& results) const {
  const std::int64_t zero = monotonic_zero_ns_.value_or(0);
  std::vector<StartedProcess> started;
  for (const Start& start : starts_) {
    results.starts.push_back(result_of(start, processes, places, first));
    started.push_back({results.starts.back(), start.name});
  }
  std::vector<LauncherStep> steps = steps_;
  for (LauncherStep& step : steps) {
    step.begin_ns += zero;
    step.end_ns += zero;
  }
  std::vector<StartCondition> conditions = conditions_;
  for (StartCondition& condition : conditions) {
    condition.held_ns += zero;
  }
  results.startup = critical_start(started, conditions, steps);
  results.launcher_events = events_.results();
}

}  // namespace tracing
