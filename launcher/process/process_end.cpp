// SPDX-License-Identifier: Apache-2.0
// Asks a supervised process to end, and handles its descendants afterwards.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "base/processes/ending_signals.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/process/supervised_process.hpp"

namespace launch {

namespace {

bool ends_processes(int signal) {
  return asks_to_end(signal) || signal == SIGKILL;
}

// One look takes 10 ms on a machine with 1,000 processes.
constexpr std::chrono::milliseconds kBetweenLooksAtGroups{100};

}  // namespace

void Supervision::interrupt(Supervised& process) {
  process.state = ProcessState::kInterrupting;
  start_timer(process, process.spec.sigterm_timeout);
  send(process, SIGINT, 0, Duration{0});
}

void Supervision::terminate(Supervised& process) {
  process.state = ProcessState::kTerminating;
  start_timer(process, process.spec.sigkill_timeout);
  send(process, SIGTERM, SIGINT, process.spec.sigterm_timeout);
  hang_up(process);
}

// A shell on a terminal takes neither SIGINT nor SIGTERM for a reason to end, but the end of its terminal.
void Supervision::hang_up(Supervised& process) {
  if (process.spec.tty && process.unreaped) {
    runner.signal_group(process.process, SIGHUP);
  }
}

void Supervision::terminate_now(Supervised& process) {
  process.state = ProcessState::kTerminating;
  start_timer(process, process.spec.sigkill_timeout);
  send(process, SIGTERM, 0, Duration{0});
  hang_up(process);
}

void Supervision::kill_at_last(Supervised& process) {
  kill(process, SIGTERM, process.spec.sigkill_timeout);
}

void Supervision::kill_now(Supervised& process) {
  kill(process, 0, Duration{0});
}

void Supervision::kill(Supervised& process, int escalated_from, Duration waited) {
  process.state = ProcessState::kKilling;
  start_timer(process, ProcessSupervisor::kHopeless);
  send(process, SIGKILL, escalated_from, waited);
  if (process.exited) {
    reap_after_kill(process);
    conclude(process);
  } else if (process.refused) {
    give_up(process);
  }
}

void Supervision::give_up(Supervised& process) {
  end_tty(process);
  process.exit_source.reset();
  process.output.close();
  process.unreaped = false;
  const ProcessLeft left{process.process.pid, process.refused};
  process.process = Process{};
  notify(process, left);
  finish(process);
}

void Supervision::send_requested(Supervised& process) {
  const bool was_told = process.told_to_end;
  send(process, process.requested_signal, 0, Duration{0});
  process.told_to_end = was_told;
  if (ends_processes(process.requested_signal)) {
    process.sent_signal = process.requested_signal;
  }
}

void Supervision::end_unasked(Supervised& process) {
  if (process.signalled) {
    end_signalled(process);
    return;
  }
  process.exit_source.reset();
  process.output.drain();
  const bool again = respawns(process);
  if (again) {
    // A wrapper has died and its program lives on. Two copies of the program would be worse than none for a moment.
    runner.signal_group(process.process, SIGKILL);
    process.output.close();
  }
  process.exited = true;
  if (process.output.is_open()) {
    report_exit(process, runner.outcome(process.process), again);
  } else {
    process.unreaped = false;
    report_exit(process, runner.reap(process.process), again);
  }
  conclude(process);
}

void Supervision::end_signalled(Supervised& process) {
  process.exit_source.reset();
  process.output.drain();
  process.exited = true;
  const bool again = respawns(process);
  if (process.output.is_open() && process.state != ProcessState::kKilling) {
    report_exit(process, runner.outcome(process.process), again);
    // Its descendants got the signal, too, and have the rest of the time.
    if (process.state == ProcessState::kRunning) {
      process.state = ProcessState::kInterrupting;
      start_timer(process, process.spec.sigterm_timeout);
    }
    watch_groups();
    return;
  }
  // Before the process is reaped: until then no other group can have its number.
  runner.signal_group(process.process, SIGKILL);
  process.unreaped = false;
  const ProcessExit exit = runner.reap(process.process);
  process.output.close();
  process.timer.reset();
  report_exit(process, exit, again);
  conclude(process);
}

void Supervision::remains_ended(Supervised& process) {
  if (process.exited) {
    reap_after_kill(process);
    conclude(process);
  }
}

// What holds its output has left the group, so it has got no signal from here, and waiting for it would lead nowhere.
// It goes on until the guardian ends it, after the launcher.
void Supervision::leave_remains(Supervised& process) {
  process.timer.reset();
  if (respawns(process)) {
    process.unreaped = false;
    runner.reap(process.process);
    process.output.close();
  }
  conclude(process);
}

// Nothing tells of the end of a descendant.
void Supervision::watch_groups() {
  if (!next_look_at_groups) {
    next_look_at_groups = loop.after(kBetweenLooksAtGroups, [this] { look_at_groups(); });
  }
}

void Supervision::look_at_groups() {
  std::vector<Supervised*> ended;
  std::vector<const Process*> leaders;
  for (const auto& process : processes) {
    const bool waits = process->state == ProcessState::kInterrupting || process->state == ProcessState::kTerminating;
    if (waits && process->exited) {
      ended.push_back(process.get());
      leaders.push_back(&process->process);
    }
  }
  next_look_at_groups.reset();
  if (ended.empty()) {
    return;
  }
  const std::vector<bool> live = runner.groups_live(leaders);
  for (std::size_t i = 0; i < ended.size(); ++i) {
    if (live[i]) {
      watch_groups();
    } else {
      handle(*ended[i], Event::kGroupEnded);
    }
  }
}

void Supervision::release_remains(Supervised& process) {
  if (process.unreaped) {
    process.unreaped = false;
    runner.reap(process.process);
    process.process = Process{};
  }
}

void Supervision::interrupt_remains(Supervised& process) {
  if (process.unreaped) {
    runner.signal_group(process.process, SIGINT);
  }
}

void Supervision::kill_remains(Supervised& process) {
  if (process.unreaped) {
    reap_after_kill(process);
  }
}

void Supervision::end_tty(Supervised& process) {
  if (process.tty) {
    process.tty->end();
  }
}

// A process that has caught the signal and fails later has failed. A launch that cannot go on without the process was
// not asked to end.
bool Supervision::died_of_sent_signal(const Supervised& process, const ProcessExit& exit) {
  constexpr int kOfShell = 128;
  return process.sent_signal != 0 && !process.spec.required &&
         (exit.code == -process.sent_signal || exit.code == kOfShell + process.sent_signal || exit.code == 0);
}

void Supervision::report_exit(Supervised& process, ProcessExit exit, bool will_respawn) {
  end_tty(process);
  exit.ran_for = process.ran_for = loop.now() - process.started;
  // Where the process has no cgroup that counts it. Nobody else of the launch has sent the signal.
  if (exit.code == -SIGKILL && !process.signalled && process.process.control_group.empty() &&
      process.spec.machine.empty()) {
    exit.out_of_memory = runner.was_ended_by_kernel(process.process, process.started);
  }
  process.last_exit = exit;
  const bool expected = process.told_to_end || shutting_down || died_of_sent_signal(process, exit);
  notify(process, ProcessExited{process.process.pid, exit, expected, will_respawn});
}

void Supervision::send(Supervised& process, int signal, int escalated_from, Duration waited) {
  process.signalled = process.signalled || ends_processes(signal);
  process.told_to_end = process.told_to_end || ends_processes(signal);
  process.refused = !runner.signal_group(process.process, signal);
  notify(process, SignalSent{signal, escalated_from, waited});
}

void Supervision::reap_after_kill(Supervised& process) {
  runner.signal_group(process.process, SIGKILL);
  process.unreaped = false;
  runner.reap(process.process);
  process.output.close();
  process.timer.reset();
}

}  // namespace launch
