#include "launcher/process/process_supervisor.hpp"

#include <poll.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <deque>
#include <exception>
#include <system_error>
#include <utility>

#include "launcher/process/child_output.hpp"
#include "launcher/process/generated_files.hpp"
#include "launcher/process/respawn_delay.hpp"

namespace launch {
namespace {

// How long the destructor waits for a process that it has killed. Only a process that hangs in the kernel takes so
// long.
constexpr int kReapTimeoutMilliseconds = 1000;

enum class Event { kStart, kExit, kOutputClosed, kTimeout, kSignal, kShutdown, kKill, kStop, kRestart };
constexpr std::size_t kEvents = 9;
constexpr std::size_t kStates = 7;

bool asks_to_end(int signal) {
  return signal == SIGINT || signal == SIGTERM || signal == SIGKILL || signal == SIGQUIT || signal == SIGHUP;
}

// What was asked for a run, and counts at its end before the respawn policy.
enum class Request { kNone, kStop, kRestart };

struct Supervised {
  Supervised(EventLoop& loop, OutputRouter& router, ProcessId number, ProcessSpec given)
      : id(number),
        label(given.name + "-" + std::to_string(number)),
        spec(std::move(given)),
        output(loop, router, {id, label, spec.output}) {}

  const ProcessId id;
  const std::string label;
  ProcessSpec spec;
  ProcessState state = ProcessState::kStarting;
  std::int64_t retries = 0;
  int requested_signal = 0;  // of the kSignal event being handled
  Request request = Request::kNone;
  RespawnDelay respawn_delay;

  // Of the current or last run.
  Process process;
  bool unreaped = false;  // `process` names a process, alive or a zombie, so its group may be signalled
  bool exited = false;    // a zombie, kept because descendants hold its output open
  bool signalled = false;
  Duration started{0};
  Duration ran_for{0};
  ChildOutput output;
  EventLoop::SourcePtr exit_source;
  EventLoop::SourcePtr timer;
};

}  // namespace

struct ProcessSupervisor::Impl {
  using Handler = void (Impl::*)(Supervised&);
  struct Pending {
    Supervised* process;
    Event event;
    int signal;  // of kSignal
  };

  Impl(EventLoop& event_loop, ProcessRunner& process_runner, OutputRouter& router)
      : loop(event_loop), runner(process_runner), output(router) {}

  // Runs the handler of the table. An event raised meanwhile, by a handler or by an observer, waits until it is done:
  // observers see the events of a process in order, and handlers run on a settled state.
  void handle(Supervised& process, Event event, int signal = 0);
  void notify(Supervised& process, decltype(ProcessEvent::what) what);

  // Handlers: what happens to a process in one state on one event.
  void ignore(Supervised&) {}
  void spawn(Supervised& process);
  void interrupt(Supervised& process);
  void terminate(Supervised& process);
  void kill_at_last(Supervised& process);
  void kill_now(Supervised& process);
  void send_requested(Supervised& process);
  void end_unasked(Supervised& process);
  void end_signalled(Supervised& process);
  void remains_ended(Supervised& process);
  void release_remains(Supervised& process);
  void interrupt_remains(Supervised& process);
  void kill_remains(Supervised& process);
  void finish(Supervised& process);
  void stop(Supervised& process);
  void stay_stopped(Supervised& process);
  void restart(Supervised& process);
  void start_again(Supervised& process);
  void restart_now(Supervised& process);
  void revive(Supervised& process);

  bool respawns(const Supervised& process) const;
  void conclude(Supervised& process);
  void wait_for_respawn(Supervised& process, Duration delay);
  void report_exit(Supervised& process, ProcessExit exit, bool will_respawn);
  void send(Supervised& process, int signal, int escalated_from, Duration waited);
  void start_timer(Supervised& process, Duration delay);
  void reap_after_kill(Supervised& process);

  static const std::array<std::array<Handler, kEvents>, kStates> kTable;

  EventLoop& loop;
  ProcessRunner& runner;
  OutputRouter& output;
  std::vector<Observer> observers;
  std::vector<std::unique_ptr<Supervised>> processes;  // of id N at N - 1
  std::size_t active = 0;
  bool shutting_down = false;
  std::deque<Pending> pending;
  bool handling = false;
  GeneratedFiles files;
};

// clang-format off
const std::array<std::array<ProcessSupervisor::Impl::Handler, kEvents>, kStates> ProcessSupervisor::Impl::kTable{{
  //                   kStart         kExit                 kOutputClosed           kTimeout             kSignal                kShutdown                 kKill                kStop                kRestart
  /* kStarting     */ {&Impl::spawn,  &Impl::ignore,        &Impl::ignore,          &Impl::ignore,       &Impl::ignore,         &Impl::ignore,            &Impl::ignore,       &Impl::ignore,       &Impl::ignore},
  /* kRunning      */ {&Impl::ignore, &Impl::end_unasked,   &Impl::ignore,          &Impl::ignore,       &Impl::send_requested, &Impl::interrupt,         &Impl::kill_now,     &Impl::stop,         &Impl::restart},
  /* kInterrupting */ {&Impl::ignore, &Impl::end_signalled, &Impl::remains_ended,   &Impl::terminate,    &Impl::send_requested, &Impl::ignore,            &Impl::kill_now,     &Impl::stay_stopped, &Impl::start_again},
  /* kTerminating  */ {&Impl::ignore, &Impl::end_signalled, &Impl::remains_ended,   &Impl::kill_at_last, &Impl::send_requested, &Impl::ignore,            &Impl::kill_now,     &Impl::stay_stopped, &Impl::start_again},
  /* kKilling      */ {&Impl::ignore, &Impl::end_signalled, &Impl::ignore,          &Impl::ignore,       &Impl::ignore,         &Impl::ignore,            &Impl::kill_now,     &Impl::stay_stopped, &Impl::start_again},
  /* kRespawnDelay */ {&Impl::ignore, &Impl::ignore,        &Impl::ignore,          &Impl::spawn,        &Impl::ignore,         &Impl::finish,            &Impl::ignore,       &Impl::finish,       &Impl::restart_now},
  /* kDone         */ {&Impl::ignore, &Impl::ignore,        &Impl::release_remains, &Impl::ignore,       &Impl::ignore,         &Impl::interrupt_remains, &Impl::kill_remains, &Impl::ignore,       &Impl::revive},
}};
// clang-format on

void ProcessSupervisor::Impl::handle(Supervised& first, Event event, int signal) {
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
    const Handler handler = kTable[static_cast<std::size_t>(next.process->state)][static_cast<std::size_t>(next.event)];
    (this->*handler)(*next.process);
  }
}

void ProcessSupervisor::Impl::notify(Supervised& process, decltype(ProcessEvent::what) what) {
  const ProcessEvent event{process.id, process.label, process.spec, std::move(what)};
  // By index: an observer may register another one.
  for (std::size_t i = 0; i < observers.size(); ++i) {
    observers[i](event);
  }
}

void ProcessSupervisor::Impl::spawn(Supervised& process) {
  process.timer.reset();
  process.exited = false;
  process.signalled = false;
  process.request = Request::kNone;
  try {
    if (process.state == ProcessState::kStarting) {
      files.write(process.spec, process.id);
    }
    process.process = runner.spawn(process.spec);
  } catch (const std::system_error& error) {
    const bool again = respawns(process);
    notify(process, ProcessStartFailed{error.what(), again});
    if (again) {
      wait_for_respawn(process,
                       std::max(process.respawn_delay.next(process.spec.respawn, Duration{0}), kFailedStartDelay));
    } else {
      finish(process);
    }
    return;
  }
  process.state = ProcessState::kRunning;
  process.unreaped = true;
  process.started = loop.now();
  process.output.follow(process.process, [this, &process] { handle(process, Event::kOutputClosed); });
  process.exit_source = loop.on_exit(process.process.pidfd.get(), [this, &process] { handle(process, Event::kExit); });
  notify(process, ProcessStarted{process.process.pid});
}

void ProcessSupervisor::Impl::interrupt(Supervised& process) {
  process.state = ProcessState::kInterrupting;
  start_timer(process, process.spec.sigterm_timeout);
  send(process, SIGINT, 0, Duration{0});
}

void ProcessSupervisor::Impl::terminate(Supervised& process) {
  process.state = ProcessState::kTerminating;
  start_timer(process, process.spec.sigkill_timeout);
  send(process, SIGTERM, SIGINT, process.spec.sigterm_timeout);
}

void ProcessSupervisor::Impl::kill_at_last(Supervised& process) {
  process.state = ProcessState::kKilling;
  process.timer.reset();
  send(process, SIGKILL, SIGTERM, process.spec.sigkill_timeout);
  if (process.exited) {
    reap_after_kill(process);
    conclude(process);
  }
}

void ProcessSupervisor::Impl::kill_now(Supervised& process) {
  process.state = ProcessState::kKilling;
  process.timer.reset();
  send(process, SIGKILL, 0, Duration{0});
  if (process.exited) {
    reap_after_kill(process);
    conclude(process);
  }
}

void ProcessSupervisor::Impl::send_requested(Supervised& process) {
  send(process, process.requested_signal, 0, Duration{0});
}

void ProcessSupervisor::Impl::end_unasked(Supervised& process) {
  if (process.signalled) {
    end_signalled(process);
    return;
  }
  process.exit_source.reset();
  process.output.drain();
  const bool again = respawns(process);
  if (again) {
    // A wrapper has died and its program lives on: two of it would be worse than none for a moment.
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

void ProcessSupervisor::Impl::end_signalled(Supervised& process) {
  process.exit_source.reset();
  process.output.drain();
  process.exited = true;
  const bool again = respawns(process);
  if (process.output.is_open() && process.state != ProcessState::kKilling) {
    report_exit(process, runner.outcome(process.process), again);
    if (process.state != ProcessState::kTerminating) {
      process.state = ProcessState::kTerminating;
      start_timer(process, process.spec.sigkill_timeout);
      send(process, SIGTERM, 0, Duration{0});
    }
    return;
  }
  // Before the process is reaped: until then no stranger's group can have its number.
  runner.signal_group(process.process, SIGKILL);
  process.unreaped = false;
  const ProcessExit exit = runner.reap(process.process);
  process.output.close();
  process.timer.reset();
  report_exit(process, exit, again);
  conclude(process);
}

void ProcessSupervisor::Impl::remains_ended(Supervised& process) {
  if (process.exited) {
    reap_after_kill(process);
    conclude(process);
  }
}

void ProcessSupervisor::Impl::release_remains(Supervised& process) {
  if (process.unreaped) {
    process.unreaped = false;
    runner.reap(process.process);
    process.process = Process{};
  }
}

void ProcessSupervisor::Impl::interrupt_remains(Supervised& process) {
  if (process.unreaped) {
    runner.signal_group(process.process, SIGINT);
  }
}

void ProcessSupervisor::Impl::kill_remains(Supervised& process) {
  if (process.unreaped) {
    reap_after_kill(process);
  }
}

void ProcessSupervisor::Impl::finish(Supervised& process) {
  process.state = ProcessState::kDone;
  process.timer.reset();
  --active;
  notify(process, ProcessDone{});
}

void ProcessSupervisor::Impl::stop(Supervised& process) {
  process.request = Request::kStop;
  interrupt(process);
}

void ProcessSupervisor::Impl::stay_stopped(Supervised& process) {
  process.request = Request::kStop;
}

void ProcessSupervisor::Impl::restart(Supervised& process) {
  start_again(process);
  if (process.request == Request::kRestart) {
    interrupt(process);
  }
}

void ProcessSupervisor::Impl::start_again(Supervised& process) {
  if (!shutting_down) {
    process.request = Request::kRestart;
  }
}

void ProcessSupervisor::Impl::restart_now(Supervised& process) {
  process.retries = 0;
  process.respawn_delay.reset();
  spawn(process);
}

void ProcessSupervisor::Impl::revive(Supervised& process) {
  if (shutting_down) {
    return;
  }
  kill_remains(process);
  process.process = Process{};
  process.output.close();
  process.retries = 0;
  process.respawn_delay.reset();
  process.state = ProcessState::kRespawnDelay;
  ++active;
  spawn(process);
}

bool ProcessSupervisor::Impl::respawns(const Supervised& process) const {
  if (shutting_down || process.request != Request::kNone) {
    return !shutting_down && process.request == Request::kRestart;
  }
  const RespawnPolicy& policy = process.spec.respawn;
  return policy.enabled && (policy.max_retries < 0 || process.retries < policy.max_retries);
}

// The run is over; what comes next?
void ProcessSupervisor::Impl::conclude(Supervised& process) {
  if (!process.unreaped) {
    process.process = Process{};
  }
  if (!respawns(process)) {
    finish(process);
  } else if (process.request == Request::kRestart) {
    process.retries = -1;  // this start is no retry
    process.respawn_delay.reset();
    wait_for_respawn(process, Duration{0});
  } else {
    wait_for_respawn(process, process.respawn_delay.next(process.spec.respawn, process.ran_for));
  }
}

void ProcessSupervisor::Impl::wait_for_respawn(Supervised& process, Duration delay) {
  process.state = ProcessState::kRespawnDelay;
  ++process.retries;
  start_timer(process, delay);
}

void ProcessSupervisor::Impl::report_exit(Supervised& process, ProcessExit exit, bool will_respawn) {
  exit.ran_for = process.ran_for = loop.now() - process.started;
  const bool expected = process.signalled || shutting_down;
  notify(process, ProcessExited{process.process.pid, exit, expected, will_respawn});
}

void ProcessSupervisor::Impl::send(Supervised& process, int signal, int escalated_from, Duration waited) {
  process.signalled = process.signalled || asks_to_end(signal);
  runner.signal_group(process.process, signal);
  notify(process, SignalSent{signal, escalated_from, waited});
}

void ProcessSupervisor::Impl::start_timer(Supervised& process, Duration delay) {
  process.timer = loop.after(delay, [this, &process] { handle(process, Event::kTimeout); });
}

void ProcessSupervisor::Impl::reap_after_kill(Supervised& process) {
  runner.signal_group(process.process, SIGKILL);
  process.unreaped = false;
  runner.reap(process.process);
  process.output.close();
  process.timer.reset();
}

ProcessSupervisor::ProcessSupervisor(EventLoop& loop, ProcessRunner& runner, OutputRouter& output)
    : impl_(std::make_unique<Impl>(loop, runner, output)) {}

ProcessSupervisor::~ProcessSupervisor() {
  try {
    for (const auto& process : impl_->processes) {
      if (process->unreaped) {
        impl_->runner.signal_group(process->process, SIGKILL);
      }
    }
    for (const auto& process : impl_->processes) {
      if (process->unreaped) {
        pollfd exited{process->process.pidfd.get(), POLLIN, 0};
        if (::poll(&exited, 1, kReapTimeoutMilliseconds) == 1) {
          impl_->runner.reap(process->process);
        }
        process->output.close();
      }
    }
  } catch (const std::exception&) {
    // All have been signalled as far as it goes; there is no one left to tell.
  }
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
  if (!observer) {
    impl_->output.observe_lines(nullptr);
    return;
  }
  impl_->output.observe_lines(
      [this, observer = std::move(observer)](ProcessId id, OutputStream stream, std::string_view line) {
        const Supervised& process = *impl_->processes.at(id - 1);
        observer(process.spec, id, process.label, stream, line);
      });
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

void ProcessSupervisor::stop(ProcessId id) {
  impl_->handle(*impl_->processes.at(id - 1), Event::kStop);
}

void ProcessSupervisor::restart(ProcessId id) {
  impl_->handle(*impl_->processes.at(id - 1), Event::kRestart);
}

void ProcessSupervisor::kill_all() {
  // By index: an observer may start a process.
  for (std::size_t i = 0; i < impl_->processes.size(); ++i) {
    impl_->handle(*impl_->processes[i], Event::kKill);
  }
}

std::size_t ProcessSupervisor::active() const {
  return impl_->active;
}

ProcessState ProcessSupervisor::state(ProcessId id) const {
  return impl_->processes.at(id - 1)->state;
}

}  // namespace launch
