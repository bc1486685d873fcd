// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/scopes/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <variant>

#include "base/monotonic_clock.hpp"

namespace launch {

void Recording::record(const LaunchRecord& record) {
  if (recorder_ != nullptr) {
    recorder_->record(record);
  }
  scopes_.record(record);
}

void Recording::record(const ProcessEvent& event) {
  using Kind = LaunchRecord::Kind;
  if (!event.spec.machine.empty()) {
    return;  // its number is one of another machine
  }
  LaunchRecord what{.name = event.label, .where = event.spec.origin, .time = monotonic_time()};
  if (const auto* const started = std::get_if<ProcessStarted>(&event.what)) {
    what.kind = Kind::kExec;
    what.pid = started->pid;
  } else if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    what.kind = Kind::kExit;
    what.pid = exited->pid;
    what.value = exited->exit.code;
    what.asked_for = exited->expected;
    record(what);
    if (!exited->will_respawn) {
      return;
    }
    what.kind = Kind::kRespawn;
  } else if (const auto* const sent = std::get_if<SignalSent>(&event.what)) {
    what.kind = Kind::kSignal;
    what.value = sent->signal;
  } else if (const auto* const change = std::get_if<SchedulingChanged>(&event.what);
             change != nullptr && change->failure.empty()) {
    what.kind = Kind::kScheduling;
    what.what = fmt::format("{}", fmt::join(change->to, ", "));
  } else {
    return;
  }
  record(what);
}

void Recording::record_ready(const std::string& process, const Dependency& dependency) {
  record({.kind = LaunchRecord::Kind::kReady,
          .name = process,
          .what = describe(dependency),
          .where = dependency.where,
          .time = monotonic_time()});
}

void Recording::record(const ConditionEvent& event) {
  record({.kind = LaunchRecord::Kind::kCondition,
          .name = tracing::describe(event.condition),
          .what = tracing::sentence(event.condition, event.change),
          .where = event.where,
          .time = monotonic_time()});
}

void Recording::record_visit(std::int64_t begin, const SourceRange& where, const Requests& requests) {
  for (const LaunchRecord& step : requests.records) {
    record(step);
  }
  record({.kind = LaunchRecord::Kind::kVisit, .where = where, .time = begin, .duration = monotonic_time() - begin});
}

void Recording::begin() {
  if (recorder_ == nullptr || begun_) {
    return;
  }
  begun_ = scopes_.want_records();
  if (begun_) {
    recorder_->begin();
  } else {
    recorder_->drop();
  }
}

void Recording::end() {
  if (std::exchange(begun_, false)) {
    recorder_->end();
  }
}

}  // namespace launch
