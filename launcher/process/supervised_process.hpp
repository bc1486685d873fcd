// SPDX-License-Identifier: Apache-2.0
// The private part of the supervisor: its state of each process, and the handlers of events. Only for
// process_supervisor.cpp, which has the table of states and events, and for process_start.cpp, process_end.cpp,
// process_respawn.cpp and process_terminal.cpp.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/process/group_scheduling.hpp"
#include "launcher/process/output/child_output.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/process/spawn/generated_files.hpp"
#include "launcher/process/tty/process_tty.hpp"

namespace launch {

// The time between an exit and the next start: always the same, or longer after each run that was short.
//
// Without any delay, a program that ends at once would be started hundreds of times a second. After ten runs in a row
// of less than a second, the delay therefore grows from 0.1 s to 5 s, until a run lasts longer.
class RespawnDelay {
 public:
  // The delay before the next start, after a run of this length (0 for a start that failed).
  Duration next(const RespawnPolicy& policy, Duration ran_for);
  // Begins the series anew.
  void reset() { *this = {}; }
  // Whether the last delay was the first one of a series that the policy does not ask for.
  bool slows_down() const { return short_runs_ == kShortRuns; }

  static constexpr int kShortRuns = 10;

 private:
  Duration delay_of_short_runs(Duration ran_for);

  Duration next_{0};    // 0: the delay of the policy
  int short_runs_ = 0;  // in a row
};

class Guardian;

enum class SupervisionEvent {
  kStart,
  kExit,
  kOutputClosed,
  kTimeout,
  kSignal,
  kShutdown,
  kTerminate,
  kKill,
  kStop,
  kRestart,
  kTerminalSignal,
  kGroupEnded,
  kUnhealthy
};

// What was asked for during a run. At the end of the run it counts before the respawn policy.
enum class SupervisionRequest { kNone, kStop, kRestart, kRestartUnhealthy };

// One process of a supervisor, over all its runs.
struct Supervised {
  Supervised(EventLoop& loop, OutputRouter& router, ProcessId number, ProcessSpec given)
      : id(number),
        label(given.name + "-" + std::to_string(number)),
        shown_label(shown_label_of(label, given)),
        spec(std::move(given)),
        output(loop, router, {id, shown_label, spec.output}) {}

  const ProcessId id;
  const std::string label;
  const std::string shown_label;  // in front of its lines
  ProcessSpec spec;
  std::function<ProcessSpec()> next;  // the spec from the next start on; null: the same
  ProcessState state = ProcessState::kStarting;
  std::int64_t retries = 0;
  int requested_signal = 0;                               // of the kSignal event being handled
  SupervisionEvent requested = SupervisionEvent::kStart;  // the event being handled
  // What was asked for before it was known whether the process starts.
  std::vector<std::pair<SupervisionEvent, int>> deferred;
  SupervisionRequest request = SupervisionRequest::kNone;
  RespawnDelay respawn_delay;
  std::deque<Duration> starts;  // that count for the limit, as far as they are recent

  // The current or last run.
  Process process;
  bool unreaped = false;              // `process` names a process, alive or a zombie, so its group may be signalled
  bool exited = false;                // a zombie, kept because descendants hold its output open
  bool signalled = false;             // by a signal that ends processes
  bool told_to_end = false;           // by such a signal, and not because somebody wanted just this signal to be sent
  int sent_signal = 0;                // the last signal of this kind that somebody wanted to be sent; 0: none
  bool waits_for_foreground = false;  // it has the terminal, and was stopped because it is not ours now
  GroupScheduling scheduling;         // what its threads had before they were changed
  bool refused = false;               // the last signal: every process of the group belongs to another user
  Duration started{0};
  Duration ran_for{0};
  std::int64_t runs = 0;  // started so far
  std::optional<ProcessExit> last_exit;
  Health health = Health::kUnwatched;
  std::string health_reason;  // of kUnhealthy
  std::string status;
  std::unique_ptr<ProcessTty> tty;  // of a spec with a tty; stays over all runs
  ChildOutput output;
  EventLoop::SourcePtr exit_source;
  EventLoop::SourcePtr timer;
  Duration timer_end{0};
};

// What a ProcessSupervisor consists of: the processes, and the events that they handle. All that happens to a process
// goes through handle(), so the handlers are private.
struct Supervision {
 public:
  using Event = SupervisionEvent;

  Supervision(EventLoop& event_loop, ProcessRunner& process_runner, OutputRouter& router)
      : loop(event_loop), runner(process_runner), output(router) {}

  // Runs the handler of the table. An event raised meanwhile, by a handler or by an observer, waits until it is done:
  // observers see the events of a process in order, and handlers run on a settled state.
  void handle(Supervised& process, Event event, int signal = 0);
  // As ProcessSupervisor::set_health().
  void set_health(Supervised& process, HealthChanged change);
  // As those of ProcessSupervisor.
  void change_scheduling(Supervised& process, const ResourceLimits& wanted);
  void restore_scheduling(Supervised& process);
  // To be called after a change of the two observers of lines.
  void observe_lines();
  // As ProcessSupervisor::watch_terminal().
  void watch_terminal();

  EventLoop& loop;
  ProcessRunner& runner;
  OutputRouter& output;
  std::vector<std::function<void(const ProcessEvent&)>> observers;
  ProcessOutputObserver on_line;
  ProcessOutputObserver on_line_outside;
  std::vector<std::unique_ptr<Supervised>> processes;  // of id N at N - 1
  std::size_t active = 0;
  bool shutting_down = false;
  GeneratedFiles files;
  Guardian* guardian = nullptr;

 private:
  using Request = SupervisionRequest;
  using Handler = void (Supervision::*)(Supervised&);
  static constexpr std::size_t kEvents = 13;
  static constexpr std::size_t kStates = 7;
  struct Pending {
    Supervised* process;
    Event event;
    int signal;  // of kSignal
  };

  // Handlers: each handles one event of a process in one state. First those of its start and of what follows a run.
  void ignore(Supervised&) {}
  void spawn(Supervised& process);
  void confirm(Supervised& process);
  void defer(Supervised& process);
  void finish(Supervised& process);
  void stop(Supervised& process);
  void stay_stopped(Supervised& process);
  void restart(Supervised& process);
  void start_again(Supervised& process);
  void restart_now(Supervised& process);
  void revive(Supervised& process);
  void restart_unhealthy(Supervised& process);
  // Those of its end (process_end.cpp).
  void interrupt(Supervised& process);
  void terminate(Supervised& process);
  void terminate_now(Supervised& process);
  void hang_up(Supervised& process);
  void kill_at_last(Supervised& process);
  void kill_now(Supervised& process);
  void give_up(Supervised& process);
  void send_requested(Supervised& process);
  void end_unasked(Supervised& process);
  void end_signalled(Supervised& process);
  void remains_ended(Supervised& process);
  void leave_remains(Supervised& process);
  void release_remains(Supervised& process);
  void interrupt_remains(Supervised& process);
  void kill_remains(Supervised& process);
  // That of a signal of the terminal (process_terminal.cpp).
  void note_signal_of_terminal(Supervised& process);

  // What handlers share.
  void notify(Supervised& process, decltype(ProcessEvent::what) what);
  bool respawns(const Supervised& process) const;
  bool wants_respawn(const Supervised& process) const;
  bool limit_reached(const Supervised& process) const;
  void start_later(Supervised& process, Duration delay);
  void conclude(Supervised& process);
  void wait_for_respawn(Supervised& process, Duration delay);
  void start_timer(Supervised& process, Duration delay);
  void begin_run(Supervised& process);
  void fail_to_start(Supervised& process, const std::system_error& error);
  void end_tty(Supervised& process);
  static bool died_of_sent_signal(const Supervised& process, const ProcessExit& exit);
  void report_exit(Supervised& process, ProcessExit exit, bool will_respawn);
  void send(Supervised& process, int signal, int escalated_from, Duration waited);
  void kill(Supervised& process, int escalated_from, Duration waited);
  void reap_after_kill(Supervised& process);

  // Looks at what nothing tells of: the groups of processes that end, and processes that the terminal has stopped.
  void watch_groups();
  void look_at_groups();
  void tell_of_stopped();
  void continue_in_foreground();

  static const std::array<std::array<Handler, kEvents>, kStates> kTable;

  std::deque<Pending> pending;
  bool handling = false;
  EventLoop::SourcePtr state_changes;  // of children
  EventLoop::SourcePtr next_look_at_groups;
  EventLoop::SourcePtr look_at_stopped;
  EventLoop::SourcePtr look_at_foreground;
};

}  // namespace launch
