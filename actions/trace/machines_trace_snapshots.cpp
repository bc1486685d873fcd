// SPDX-License-Identifier: Apache-2.0
// The flight recorder of a trace of several machines: what is a reason for a snapshot of all.
#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "actions/trace/machines_trace.hpp"

namespace launch {

std::string warning_of_clock(const std::string& machine, std::int64_t ahead_ns, double message_deadline_ms) {
  const double ahead_ms = static_cast<double>(ahead_ns) / 1e6;
  if (message_deadline_ms == 0 || std::abs(ahead_ms) <= message_deadline_ms / 2) {
    return {};
  }
  return fmt::format(
      "the clock of machine '{}' is {:.3f} ms {} that of the launch: snapshot-on-late-message takes "
      "messages between machines for so much older or younger than they are",
      machine, std::abs(ahead_ms), ahead_ms > 0 ? "ahead of" : "behind");
}

void MachinesTrace::begin_snapshots() {
  std::vector<MachineRecorder*> machines;
  for (const auto& part : parts_) {
    machines.push_back(part->recorder.get());
  }
  snapshots_ = std::make_unique<SnapshotRounds>(
      *loop_,
      SnapshotRounds::Settings{.directory = directory(),
                               .session = session(),
                               .limit = request_.config.snapshot_limit,
                               .collects = settings_.collects,
                               .is_used = [this](const std::string& machine) { return used_.contains(machine); }},
      here_.get(), std::move(machines), tell_, snapshot_observer_, [this] { return unrecorded(); });
  snapshot_requests_ = listen_for_snapshots(session());
  if (snapshot_requests_) {
    snapshot_requests_source_ = loop_->on_readable(snapshot_requests_.get(), [this] { take_request(); });
  } else {
    tell_(true, fmt::format("'launch trace record_snapshot {0}' does not reach this launch: another one has a session "
                            "'{0}'",
                            session()));
  }
  for (const auto& part : parts_) {
    const std::string warning =
        warning_of_clock(part->result.machine, part->recorder->clock_ahead(), request_.choices.message_deadline);
    if (!warning.empty()) {
      tell_(true, warning);
    }
  }
  if (const int number = request_.choices.snapshot_on_signal; number != 0 && !here_) {
    snapshot_signal_ = loop_->on_signal({number}, [this](EventLoop::Signal signal) {
      want_by_event(fmt::format("SIG{}", ::sigabbrev_np(signal.number)));
    });
  }
}

void MachinesTrace::take_request() {
  if (const auto asker = std::make_shared<UniqueFd>(take_snapshot_request(snapshot_requests_)); *asker) {
    snapshots_->want({.reason = "launch trace record_snapshot",
                      .answer = [asker](const SnapshotAnswer& answer) { send_snapshot_answer(*asker, answer); }});
  }
}

void MachinesTrace::want_by_event(const std::string& reason) {
  if (snapshots_) {
    snapshots_->want({.reason = reason, .late = tracing::late_events(request_.choices, {reason})});
  }
}

// A machine may say anything: only reasons that the trace has count.
void MachinesTrace::want_of(const std::string& machine, const MachineRecorder::Reason& reason) {
  using Kind = MachineRecorder::Reason::Kind;
  const TraceChoices& choices = request_.choices;
  const std::vector<std::string> known = tracing::reasons_by_events(choices);
  const bool is_reason = reason.kind == Kind::kEvent ? std::find(known.begin(), known.end(), reason.text) != known.end()
                                                     : choices.snapshot_on_crash;
  if (!snapshots_ || !is_reason) {
    return;
  }
  switch (reason.kind) {
    case Kind::kEvent:
      snapshots_->want({.reason = fmt::format("{}: {}", machine, reason.text), .machine = machine});
      return;
    case Kind::kEndOfProcess:
      snapshots_->want({.reason = end_as_reason(fmt::format("{}:{}", machine, reason.text), reason.code),
                        .machine = machine,
                        .died = reason.text});
      return;
    case Kind::kLost:
      snapshots_->want({.reason = fmt::format("machine '{}' is lost", machine)});
      return;
  }
}

void MachinesTrace::record(const LaunchRecord& record) {
  if (here_) {
    here_->record(record);
  }
  if (snapshots_ && request_.choices.snapshot_on_crash && record.kind == LaunchRecord::Kind::kExit &&
      record.value != 0 && !record.asked_for) {
    snapshots_->want({.reason = end_as_reason(record.name, record.value), .died = record.name});
  }
}

void MachinesTrace::observe_snapshots(SnapshotObserver observer) {
  snapshot_observer_ = observer;
  if (here_) {
    here_->observe_snapshots(std::move(observer));
  }
}

}  // namespace launch
