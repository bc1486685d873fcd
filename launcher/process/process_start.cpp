// SPDX-License-Identifier: Apache-2.0
// Starts a supervised process. One on another machine has started when the machine says so; what is asked for before
// waits until then.
#include <algorithm>
#include <system_error>
#include <utility>

#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/process/supervised_process.hpp"

namespace launch {

void Supervision::spawn(Supervised& process) {
  process.timer.reset();
  process.exited = false;
  process.signalled = false;
  process.told_to_end = false;
  process.sent_signal = 0;
  process.refused = false;
  process.scheduling = {};
  process.waits_for_foreground = false;
  process.request = Request::kNone;
  if (process.spec.start_limit.starts > 0) {
    process.starts.push_back(loop.now());
  }
  const bool is_new = process.state == ProcessState::kStarting || process.next;
  if (process.next) {
    process.spec = process.next();
    process.next = nullptr;
  }
  try {
    if (is_new) {
      process.spec.label = process.label;
      if (process.spec.machine.empty()) {
        files.write(process.spec, process.id);
      } else {
        for (const GeneratedFile& file : process.spec.files) {  // they are written there, so the paths are not known
          process.spec.argv.at(file.argument) = "<" + file.name + " on " + process.spec.machine + ">";
        }
      }
      process.spec.mark = guardian == nullptr ? "" : guardian->mark(process.label, process.spec);
    }
    process.process = runner.spawn(process.spec);
  } catch (const std::system_error& error) {
    fail_to_start(process, error);
    return;
  }
  if (process.process.starting) {
    process.state = ProcessState::kStarting;
    process.exit_source =
        loop.on_exit(process.process.pidfd.get(), [this, &process] { handle(process, SupervisionEvent::kExit); });
    return;
  }
  begin_run(process);
}

void Supervision::fail_to_start(Supervised& process, const std::system_error& error) {
  const bool again = dynamic_cast<const NeverStarts*>(&error) == nullptr;
  notify(process, ProcessStartFailed{error.what(), again && respawns(process)});
  if (again && wants_respawn(process)) {
    start_later(process, std::max(process.respawn_delay.next(process.spec.respawn, Duration{0}),
                                  ProcessSupervisor::kFailedStartDelay));
  } else {
    finish(process);
  }
}

// It is known now whether a process on another machine has started.
void Supervision::confirm(Supervised& process) {
  process.exit_source.reset();
  const std::vector<std::pair<SupervisionEvent, int>> deferred = std::exchange(process.deferred, {});
  const auto asked_for = [&](SupervisionEvent event) {
    return std::any_of(deferred.begin(), deferred.end(), [&](const auto& each) { return each.first == event; });
  };
  try {
    runner.confirm(process.process);
  } catch (const std::system_error& error) {
    process.process = Process{};
    if (asked_for(SupervisionEvent::kStop) && !asked_for(SupervisionEvent::kRestart)) {
      process.request = Request::kStop;
    }
    fail_to_start(process, error);
    return;
  }
  begin_run(process);
  for (const auto& [event, signal] : deferred) {
    pending.push_back({&process, event, signal});
  }
}

void Supervision::defer(Supervised& process) {
  process.deferred.emplace_back(process.requested, process.requested_signal);
}

// The process runs.
void Supervision::begin_run(Supervised& process) {
  if (guardian != nullptr && process.spec.machine.empty()) {
    guardian->note(process.id, process.process.pid, process.label, process.spec);
  }
  process.state = ProcessState::kRunning;
  process.unreaped = true;
  process.started = loop.now();
  ++process.runs;
  process.health = process.spec.watches.empty() ? Health::kUnwatched : Health::kStarting;
  process.health_reason.clear();
  process.status.clear();
  ChildOutput::Observer on_bytes;
  if (process.spec.tty) {
    if (!process.tty) {
      process.tty = std::make_unique<ProcessTty>(loop);
    }
    process.tty->begin(process.process.in.get());
    on_bytes = [tty = process.tty.get()](std::string_view bytes) { tty->add_output(bytes); };
  }
  process.output.follow(
      process.process, [this, &process] { handle(process, SupervisionEvent::kOutputClosed); }, std::move(on_bytes));
  process.exit_source =
      loop.on_exit(process.process.pidfd.get(), [this, &process] { handle(process, SupervisionEvent::kExit); });
  notify(process, ProcessStarted{process.process.pid, process.spec.terminal_input && !process.process.has_terminal});
}

}  // namespace launch
