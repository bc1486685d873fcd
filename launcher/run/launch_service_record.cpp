// SPDX-License-Identifier: Apache-2.0
// What the launch tells its recorder and its scopes.
#include <algorithm>

#include "launcher/base/monotonic_clock.hpp"
#include "launcher/run/launch_service.hpp"

namespace launch {

void LaunchService::record(const LaunchRecord& record) {
  if (recorder_ != nullptr) {
    recorder_->record(record);
  }
  for (const auto& scope : active_scopes_) {
    scope->record(record);
  }
}

void LaunchService::record(const ProcessEvent& event) {
  using Kind = LaunchRecord::Kind;
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
  } else {
    return;
  }
  record(what);
}

void LaunchService::record_visit(std::int64_t begin, const SourceRange& where, Requests& requests) {
  for (const LaunchRecord& step : requests.records) {
    record(step);
  }
  record({.kind = LaunchRecord::Kind::kVisit, .where = where, .time = begin, .duration = monotonic_time() - begin});
}

// Called when the scopes of some requests have begun, before their processes start.
void LaunchService::begin_recording() {
  if (recorder_ == nullptr || recording_) {
    return;
  }
  recording_ = std::any_of(active_scopes_.begin(), active_scopes_.end(),
                           [](const auto& scope) { return scope->wants_records(); });
  if (recording_) {
    recorder_->begin();
  } else {
    recorder_->drop();
  }
}

}  // namespace launch
