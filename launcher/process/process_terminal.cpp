// SPDX-License-Identifier: Apache-2.0
// What supervised processes have to do with the terminal of the launch: one that has it gets its signals, and one that
// reads it from the background is stopped by the system.
#include <signal.h>

#include <chrono>
#include <utility>

#include "launcher/process/process_supervisor.hpp"
#include "launcher/process/supervised_process.hpp"

namespace launch {
namespace {

// SIGCHLD comes with each exit, too, so a look at all children follows at most so often.
constexpr Duration kBetweenLooks = std::chrono::milliseconds(100);
// A shell that puts a job into the foreground tells nobody. Only a launch with a process that waits for it looks.
constexpr Duration kBetweenLooksAtForeground = std::chrono::milliseconds(200);

}  // namespace

void ProcessSupervisor::note_signal_of_terminal() {
  for (const auto& process : impl_->processes) {
    impl_->handle(*process, SupervisionEvent::kTerminalSignal);
  }
}

void Supervision::note_signal_of_terminal(Supervised& process) {
  if (process.process.has_terminal) {
    process.request = Request::kStop;
    process.signalled = true;
    process.told_to_end = true;
    process.state = ProcessState::kInterrupting;
    start_timer(process, process.spec.sigterm_timeout);
  }
}

void ProcessSupervisor::watch_terminal() {
  impl_->watch_terminal();
}

void Supervision::watch_terminal() {
  state_changes = loop.on_signal({SIGCHLD}, [this](EventLoop::Signal) {
    if (!look_at_stopped) {
      look_at_stopped = loop.after(kBetweenLooks, [this] { tell_of_stopped(); });
    }
  });
}

void Supervision::tell_of_stopped() {
  look_at_stopped.reset();
  for (const StoppedChild& stopped : runner.take_stopped()) {
    if (stopped.signal != SIGTTIN && stopped.signal != SIGTTOU) {
      continue;
    }
    for (std::size_t i = 0; i < processes.size(); ++i) {
      Supervised& process = *processes[i];
      if (process.unreaped && process.process.pid == stopped.pid && process.spec.machine.empty()) {
        process.waits_for_foreground = process.process.has_terminal;
        notify(process, ProcessWaitsForTerminal{stopped.pid, stopped.signal == SIGTTIN, process.process.has_terminal});
        break;
      }
    }
  }
  continue_in_foreground();
}

void Supervision::continue_in_foreground() {
  look_at_foreground.reset();
  const bool goes_on = runner.in_foreground();
  bool some_wait = false;
  for (const auto& process : processes) {
    if (!process->unreaped || !process->waits_for_foreground) {
      continue;
    }
    if (goes_on) {
      process->waits_for_foreground = false;
      runner.signal_group(process->process, SIGCONT);
    } else {
      some_wait = true;
    }
  }
  if (some_wait) {
    look_at_foreground = loop.after(kBetweenLooksAtForeground, [this] { continue_in_foreground(); });
  }
}

}  // namespace launch
