// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/start_tracker.hpp"

#include <algorithm>

namespace tracing {

namespace {

std::string text_of(const Event& event, std::string_view field) {
  const std::optional<FieldValue> value = event.field(field);
  return std::string(value ? value->string().value_or("") : "");
}

std::int64_t number_of(const Event& event, std::string_view field) {
  const std::optional<FieldValue> value = event.field(field);
  return value ? value->integer().value_or(0) : 0;
}

// Whether the event comes from lttng-ust's own thread, which reports the living objects when a session starts.
bool is_of_state_dump(const Event& event) {
  return !event.procname || event.procname->ends_with("-ust");
}

}  // namespace

StartTracker::Kind StartTracker::kind_of(const Event& event) {
  const std::size_t id = event.event_class->id;
  if (id >= kinds_.size()) kinds_.resize(id + 1);
  if (!kinds_[id]) {
    const std::string_view name = event.name();
    if (name == "launch:exec") {
      kinds_[id] = Kind::kExec;
    } else if (name.starts_with("launch:")) {
      kinds_[id] = Kind::kLaunch;
    } else if (name == "ros2:rcl_node_init") {
      kinds_[id] = Kind::kNode;
    } else if (name.starts_with("ros2:rclcpp_executor_")) {
      kinds_[id] = Kind::kExecutor;
    } else {
      kinds_[id] = Kind::kOther;
    }
  }
  return *kinds_[id];
}

void StartTracker::on_event(const Event& event) {
  const Kind kind = kind_of(event);
  if (kind == Kind::kOther) return;
  if (kind == Kind::kExec || kind == Kind::kLaunch) {
    const std::int64_t time = number_of(event, "time");
    if (time == 0) return;
    const std::int64_t zero = event.timestamp_ns - time;
    monotonic_zero_ns_ = std::min(monotonic_zero_ns_.value_or(zero), zero);
    if (kind == Kind::kExec) {
      StartResult result{.vpid = number_of(event, "pid"),
                         .process = text_of(event, "process"),
                         .file = text_of(event, "file"),
                         .line = number_of(event, "line")};
      starts_.push_back({std::move(result), time});
    }
    return;
  }
  if (!event.vpid) return;
  Process& process = processes_[*event.vpid];
  if (process.late) return;
  if (kind == Kind::kNode) {
    if (process.node_ns) return;
    if (is_of_state_dump(event)) {
      process.late = true;
    } else {
      process.node_ns = event.timestamp_ns;
    }
  } else if (process.node_ns && !process.executor_ns) {
    process.executor_ns = event.timestamp_ns;
  }
}

std::vector<StartResult> StartTracker::finish() const {
  std::vector<StartResult> results;
  for (const Start& start : starts_) {
    StartResult result = start.result;
    result.exec_ns = start.monotonic_ns + monotonic_zero_ns_.value_or(0);
    if (const auto found = processes_.find(result.vpid); found != processes_.end() && !found->second.late) {
      const auto after = [&](const std::optional<std::int64_t>& time) -> std::optional<std::int64_t> {
        if (!time) return std::nullopt;
        return std::max<std::int64_t>(*time - result.exec_ns, 0);
      };
      result.node_after_ns = after(found->second.node_ns);
      result.ready_after_ns = after(found->second.executor_ns);
    }
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace tracing
