// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/process_supervisor.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/supervised_process.hpp"

namespace launch {

namespace {

// How long the destructor waits for a process that it has killed. Only a process that hangs in the kernel needs so much
// time.
constexpr int kReapTimeoutMilliseconds = 1000;

using Event = SupervisionEvent;

}  // namespace

// clang-format off
const std::array<std::array<Supervision::Handler, Supervision::kEvents>, Supervision::kStates> Supervision::kTable{{
  //                   kStart                kExit                        kOutputClosed                  kTimeout                    kSignal                       kShutdown                        kTerminate                     kKill                       kStop                       kRestart                       kTerminalSignal                         kGroupEnded   kUnhealthy
  /* kStarting     */ {&Supervision::spawn,  &Supervision::confirm,       &Supervision::ignore,          &Supervision::ignore,       &Supervision::defer,          &Supervision::defer,             &Supervision::defer,           &Supervision::defer,        &Supervision::defer,        &Supervision::defer,  &Supervision::ignore, &Supervision::ignore, &Supervision::ignore},
  /* kRunning      */ {&Supervision::ignore, &Supervision::end_unasked,   &Supervision::ignore,          &Supervision::ignore,       &Supervision::send_requested, &Supervision::interrupt,         &Supervision::terminate_now,   &Supervision::kill_now,     &Supervision::stop,         &Supervision::restart, &Supervision::note_signal_of_terminal, &Supervision::ignore, &Supervision::restart_unhealthy},
  /* kInterrupting */ {&Supervision::ignore, &Supervision::end_signalled, &Supervision::remains_ended,   &Supervision::terminate,    &Supervision::send_requested, &Supervision::ignore,            &Supervision::terminate_now,   &Supervision::kill_now,     &Supervision::stay_stopped, &Supervision::start_again, &Supervision::ignore, &Supervision::leave_remains, &Supervision::ignore},
  /* kTerminating  */ {&Supervision::ignore, &Supervision::end_signalled, &Supervision::remains_ended,   &Supervision::kill_at_last, &Supervision::send_requested, &Supervision::ignore,            &Supervision::ignore,          &Supervision::kill_now,     &Supervision::stay_stopped, &Supervision::start_again, &Supervision::ignore, &Supervision::leave_remains, &Supervision::ignore},
  /* kKilling      */ {&Supervision::ignore, &Supervision::end_signalled, &Supervision::ignore,          &Supervision::give_up,      &Supervision::ignore,         &Supervision::ignore,            &Supervision::ignore,          &Supervision::kill_now,     &Supervision::stay_stopped, &Supervision::start_again, &Supervision::ignore, &Supervision::ignore, &Supervision::ignore},
  /* kRespawnDelay */ {&Supervision::ignore, &Supervision::ignore,        &Supervision::ignore,          &Supervision::spawn,        &Supervision::ignore,         &Supervision::finish,            &Supervision::ignore,          &Supervision::ignore,       &Supervision::finish,       &Supervision::restart_now, &Supervision::ignore, &Supervision::ignore, &Supervision::ignore},
  /* kDone         */ {&Supervision::ignore, &Supervision::ignore,        &Supervision::release_remains, &Supervision::ignore,       &Supervision::ignore,         &Supervision::interrupt_remains, &Supervision::ignore,          &Supervision::kill_remains, &Supervision::ignore,       &Supervision::revive, &Supervision::ignore, &Supervision::ignore, &Supervision::ignore},
}};
// clang-format on

void Supervision::handle(Supervised& first, Event event, int signal) {
  pending.push_back({&first, event, signal});
  if (handling) {
    return;
  }
  handling = true;
  struct Reset {
    bool& flag;
    ~Reset() { flag = false; }
  } reset{handling};
  while (!pending.empty()) {
    const Pending next = pending.front();
    pending.pop_front();
    next.process->requested_signal = next.signal;
    next.process->requested = next.event;
    const Handler handler = kTable[static_cast<std::size_t>(next.process->state)][static_cast<std::size_t>(next.event)];
    (this->*handler)(*next.process);
  }
}

void Supervision::notify(Supervised& process, decltype(ProcessEvent::what) what) {
  const ProcessEvent event{process.id, process.label, process.spec, std::move(what)};
  // Loops by index, because an observer may register another one.
  for (std::size_t i = 0; i < observers.size(); ++i) {
    observers[i](event);
  }
}

void Supervision::observe_lines() {
  if (!on_line && !on_line_outside) {
    output.observe_lines(nullptr);
    return;
  }
  output.observe_lines([this](ProcessId id, OutputStream stream, std::string_view line) {
    const Supervised& process = *processes.at(id - 1);
    for (const auto* const observer : {&on_line, &on_line_outside}) {
      if (*observer) {
        (*observer)(process.spec, id, process.label, stream, line);
      }
    }
  });
}

void Supervision::change_scheduling(Supervised& process, const ResourceLimits& wanted) {
  if (!process.unreaped || process.exited) {
    notify(process, SchedulingChanged{describe(wanted), "it does not run now"});
    return;
  }
  const std::optional<SchedulingFailure> failure =
      runner.change_scheduling(process.process, wanted, process.scheduling);
  notify(process, SchedulingChanged{describe(wanted), failure ? failure_text(*failure, wanted) : ""});
}

void Supervision::restore_scheduling(Supervised& process) {
  if (process.unreaped && !process.exited && !process.scheduling.threads.empty()) {
    const std::optional<SchedulingFailure> failure = runner.restore_scheduling(process.process, process.scheduling);
    if (!failure) {
      process.scheduling = {};
    }
    notify(process, SchedulingChanged{{}, failure ? failure_text(*failure, {}) : ""});
  }
}

void Supervision::finish(Supervised& process) {
  process.state = ProcessState::kDone;
  process.timer.reset();
  --active;
  notify(process, ProcessDone{});
}

void Supervision::stop(Supervised& process) {
  process.request = Request::kStop;
  interrupt(process);
}

void Supervision::stay_stopped(Supervised& process) {
  process.request = Request::kStop;
}

void Supervision::restart(Supervised& process) {
  start_again(process);
  if (process.request == Request::kRestart) {
    interrupt(process);
  }
}

void Supervision::start_again(Supervised& process) {
  if (!shutting_down) {
    process.request = Request::kRestart;
    process.starts.clear();
  }
}

void Supervision::restart_now(Supervised& process) {
  process.retries = 0;
  process.starts.clear();
  process.respawn_delay.reset();
  spawn(process);
}

void Supervision::revive(Supervised& process) {
  if (shutting_down) {
    return;
  }
  kill_remains(process);
  process.process = Process{};
  process.output.close();
  process.retries = 0;
  process.starts.clear();
  process.respawn_delay.reset();
  process.state = ProcessState::kRespawnDelay;
  ++active;
  spawn(process);
}

void Supervision::start_timer(Supervised& process, Duration delay) {
  process.timer_end = loop.now() + delay;
  process.timer = loop.after(delay, [this, &process] { handle(process, Event::kTimeout); });
}

ProcessSupervisor::ProcessSupervisor(EventLoop& loop, ProcessRunner& runner, OutputRouter& output)
    : impl_(std::make_unique<Supervision>(loop, runner, output)) {}

ProcessSupervisor::~ProcessSupervisor() {
  try {
    for (const auto& process : impl_->processes) {
      if (process->unreaped) {
        impl_->runner.signal_group(process->process, SIGKILL);
      }
    }
    for (const auto& process : impl_->processes) {
      if (process->unreaped && process->spec.machine.empty()) {  // the agent of another machine ends its processes
        pollfd exited{process->process.pidfd.get(), POLLIN, 0};
        if (::poll(&exited, 1, kReapTimeoutMilliseconds) == 1) {
          impl_->runner.reap(process->process);
        }
        process->output.close();
      }
    }
  } catch (const std::exception&) {
    // All processes have been signalled as far as possible, and a destructor can't report the error.
  }
}

void ProcessSupervisor::use_guardian(Guardian& guardian) {
  impl_->guardian = &guardian;
  auto number = std::make_shared<std::int32_t>(0);
  impl_->files.announce_to(
      [&guardian, number](const std::string& path) {
        *number = guardian.add_clean_up({"/bin/rm", "-rf", "--", path});
      },
      [&guardian, number] { guardian.remove_clean_up(*number); });
}

void ProcessSupervisor::observe(Observer observer) {
  impl_->observers.push_back(std::move(observer));
}

ProcessId ProcessSupervisor::start(ProcessSpec spec) {
  if (impl_->shutting_down) {
    return 0;
  }
  const ProcessId id = next_id();
  impl_->processes.push_back(std::make_unique<Supervised>(impl_->loop, impl_->output, id, std::move(spec)));
  ++impl_->active;
  impl_->handle(*impl_->processes.back(), Event::kStart);
  return id;
}

ProcessId ProcessSupervisor::next_id() const {
  return static_cast<ProcessId>(impl_->processes.size() + 1);
}

void ProcessSupervisor::observe_output(OutputObserver observer) {
  impl_->on_line = std::move(observer);
  impl_->observe_lines();
}

void ProcessSupervisor::observe_output_from_outside(OutputObserver observer) {
  impl_->on_line_outside = std::move(observer);
  impl_->observe_lines();
}

void ProcessSupervisor::shutdown() {
  if (impl_->shutting_down) {
    return;
  }
  impl_->shutting_down = true;
  for (const auto& process : impl_->processes) {
    impl_->handle(*process, Event::kShutdown);
  }
}

void ProcessSupervisor::signal(ProcessId id, int signal) {
  impl_->handle(*impl_->processes.at(id - 1), Event::kSignal, signal);
}

void ProcessSupervisor::suspend() {
  for (const auto& process : impl_->processes) {
    if (process->unreaped) {
      impl_->runner.signal_group(process->process, SIGSTOP);
    }
  }
  for (const auto& process : impl_->processes) {
    if (process->unreaped && process->process.has_terminal) {
      impl_->runner.await_stop(process->process);
    }
  }
}

void ProcessSupervisor::resume() {
  for (const auto& process : impl_->processes) {
    if (process->unreaped) {
      impl_->runner.signal_group(process->process, SIGCONT);
    }
  }
}

void ProcessSupervisor::change_scheduling(ProcessId id, const ResourceLimits& wanted) {
  impl_->change_scheduling(*impl_->processes.at(id - 1), wanted);
}

void ProcessSupervisor::restore_scheduling(ProcessId id) {
  impl_->restore_scheduling(*impl_->processes.at(id - 1));
}

void ProcessSupervisor::pause(ProcessId id) {
  if (const Supervised& process = *impl_->processes.at(id - 1); process.unreaped) {
    impl_->runner.signal_group(process.process, SIGSTOP);
  }
}

void ProcessSupervisor::resume(ProcessId id) {
  if (const Supervised& process = *impl_->processes.at(id - 1); process.unreaped) {
    impl_->runner.signal_group(process.process, SIGCONT);
  }
}

std::optional<std::uint64_t> ProcessSupervisor::limit(ProcessId id, int resource, std::uint64_t soft) {
  const Supervised& process = *impl_->processes.at(id - 1);
  return process.unreaped && !process.exited ? impl_->runner.limit(process.process, resource, soft) : std::nullopt;
}

bool ProcessSupervisor::write(ProcessId id, std::string_view text) {
  const Supervised& process = *impl_->processes.at(id - 1);
  // The pipe would block this loop if the process did not read.
  const int pipe = process.unreaped && !process.exited ? process.process.in.get() : -1;
  return pipe >= 0 && ::fcntl(pipe, F_SETFL, O_NONBLOCK) == 0 &&
         ::write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

ProcessTty* ProcessSupervisor::tty(ProcessId id) const {
  const Supervised& process = *impl_->processes.at(id - 1);
  return process.spec.tty ? process.tty.get() : nullptr;
}

void ProcessSupervisor::stop(ProcessId id) {
  impl_->handle(*impl_->processes.at(id - 1), Event::kStop);
}

void ProcessSupervisor::restart(ProcessId id) {
  impl_->handle(*impl_->processes.at(id - 1), Event::kRestart);
}

ProcessRunner& ProcessSupervisor::runner() const {
  return impl_->runner;
}

const std::string& ProcessSupervisor::files_directory() const {
  return impl_->files.directory();
}

Duration ProcessSupervisor::terminate_all() {
  Duration longest{0};
  for (std::size_t i = 0; i < impl_->processes.size(); ++i) {
    Supervised& process = *impl_->processes[i];
    impl_->handle(process, Event::kTerminate);
    if (process.state == ProcessState::kTerminating) {
      longest = std::max(longest, process.spec.sigkill_timeout);
    }
  }
  return longest;
}

void ProcessSupervisor::kill_all() {
  // Loops by index, because an observer may start a process.
  for (std::size_t i = 0; i < impl_->processes.size(); ++i) {
    impl_->handle(*impl_->processes[i], Event::kKill);
  }
}

std::vector<std::string> ProcessSupervisor::alive() const {
  std::vector<std::string> labels;
  for (const auto& process : impl_->processes) {
    if (process->unreaped && process->state != ProcessState::kDone) {
      labels.push_back(process->label);
    }
  }
  return labels;
}

std::size_t ProcessSupervisor::active() const {
  return impl_->active;
}

ProcessState ProcessSupervisor::state(ProcessId id) const {
  return impl_->processes.at(id - 1)->state;
}

ProcessView ProcessSupervisor::view(ProcessId id) const {
  const Supervised& process = *impl_->processes.at(id - 1);
  const bool runs = process.unreaped && !process.exited;
  return {.label = process.label,
          .spec = process.spec,
          .state = process.state,
          .pid = runs ? process.process.pid : -1,
          .running_for = runs ? impl_->loop.now() - process.started : Duration{0},
          .next_step_in = process.timer ? process.timer_end - impl_->loop.now() : Duration{0},
          .runs = process.runs,
          .last_exit = process.last_exit,
          .health = runs ? process.health : Health::kUnwatched,
          .health_reason = process.health_reason,
          .status = process.status};
}

}  // namespace launch
