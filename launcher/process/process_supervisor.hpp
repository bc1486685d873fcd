// SPDX-License-Identifier: Apache-2.0
// Owns the state of every process of a launch, from the request to start it to its last exit.
//
// A process is a row of the State x Event table in process_supervisor.cpp. The console, the logs and the launch events
// observe transitions. The work per event does not depend on the number of processes.
//
// A process is supervised together with its group, so descendants count too unless they leave the group:
// - Signals go to the group. When a process that was signalled exits before its descendants have closed its output,
//   they have the rest of the timeouts, as if it still ran; ProcessDone waits for them, ProcessExited does not. It does
//   not wait for those that have left the group: their output is shown, and the guardian ends them after the launcher.
// - When a process exits on its own, ProcessDone follows at once. Descendants that hold its output open go on, and
//   their output is shown; they get SIGINT at shutdown and SIGKILL when the supervisor is destroyed. A respawn kills
//   them first.
// - Descendants that have closed the output are killed with a signalled process, and otherwise left alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/process/process_runner.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

class Guardian;
class ProcessTty;
struct Supervision;

// What is known of a process now. The references stay valid as long as the supervisor.
struct ProcessView {
  const std::string& label;
  const ProcessSpec& spec;
  ProcessState state;
  pid_t pid;  // -1: it does not run
  Duration running_for;
  Duration next_step_in;  // until the next signal of its end, or its next start; 0: nothing is timed
  std::int64_t runs;      // how often it has been started
  std::optional<ProcessExit> last_exit;
  Health health;
  const std::string& health_reason;
  const std::string& status;  // what it says of itself, by sd_notify(3)
};

class ProcessSupervisor {
 public:
  // Least time between a failed start and the next try: with a respawn delay of 0 a missing program would otherwise
  // keep the launcher busy and flood the screen.
  static constexpr Duration kFailedStartDelay = std::chrono::seconds(1);

  // A process that has not ended so long after SIGKILL never will: it belongs to another user or hangs in the kernel.
  static constexpr Duration kHopeless = std::chrono::seconds(10);

  using Observer = std::function<void(const ProcessEvent&)>;

  // All references must outlive the supervisor.
  ProcessSupervisor(EventLoop& loop, ProcessRunner& runner, OutputRouter& output);
  ~ProcessSupervisor();  // kills what is still alive

  // Tells the guardian about each process and about generated files. It must outlive the supervisor.
  void use_guardian(Guardian& guardian);

  // Called for every event, in the order of registration. Observers may call start(), shutdown() and signal().
  void observe(Observer observer);

  // Takes a process over and starts it now. A failing start is an event, not an exception: ProcessExited is not sent
  // then, and respawn applies as to an exit with code 127, but not sooner than kFailedStartDelay. When an observer
  // calls this, the process starts after the event that is being observed. After shutdown() new requests are ignored:
  // returns 0.
  ProcessId start(ProcessSpec spec);

  // The number that the next start() will return, unless an observer starts a process before.
  ProcessId next_id() const;

  // Called for every line of every process, before the router writes it and before the exit of its process is reported.
  // One observer for the launch and one for those who look at it from outside, null for none; it must not call the
  // supervisor.
  using OutputObserver = ProcessOutputObserver;
  void observe_output(OutputObserver observer);
  void observe_output_from_outside(OutputObserver observer);

  // Ends everything: SIGINT now, SIGTERM and SIGKILL after the timeouts of each spec; pending respawns are dropped.
  // A process that is being started is interrupted after its start. Later calls have no effect.
  void shutdown();

  // Sends a signal to the group of a running process (a SignalSent event follows). Nothing escalates. Ignored for a
  // process that does not run.
  void signal(ProcessId id, int signal);

  // The terminal has sent a signal that ends programs to the processes that have it: they are being ended, without
  // SIGINT from here.
  void note_signal_of_terminal();

  // From now on, ProcessWaitsForTerminal tells of processes that read the terminal from the background.
  void watch_terminal();

  // Stops all processes with SIGSTOP, as Ctrl-Z stops a program of a shell, and lets them go on.
  void suspend();
  void resume();

  // Changes the niceness, the policy and the CPUs of all threads of the group of a running process, as far as `wanted`
  // says them, and gives all of them what they had before (a SchedulingChanged event follows). When the process is
  // started again it has what its spec says. Ignored for a process that does not run.
  void change_scheduling(ProcessId id, const ResourceLimits& wanted);
  void restore_scheduling(ProcessId id);

  // Stops the group of one running process, and lets it go on. Nobody is told. Ignored for a process that does not run.
  void pause(ProcessId id);
  void resume(ProcessId id);
  // As ProcessRunner::limit(); nullopt for a process that does not run, too.
  std::optional<std::uint64_t> limit(ProcessId id, int resource, std::uint64_t soft);

  // Writes to the standard input of a running process. False if it does not run, or does not read.
  bool write(ProcessId id, std::string_view text);

  // The terminal of a process with a tty; null for another one, and before its first start.
  ProcessTty* tty(ProcessId id) const;

  // Ends one process as shutdown() ends all of them: it does not respawn, whatever its policy says.
  void stop(ProcessId id);

  // Ends one process in the same way and starts it again at once. A process that is done is just started. The retries
  // of its respawn policy are counted anew. Ignored after shutdown().
  void restart(ProcessId id);

  // Does the same because the process is unhealthy: the start counts for its limit of starts, and may not come.
  void restart_unhealthy(ProcessId id);

  // Takes over from another spec what is no matter of the start of a process: how it respawns, its timeouts, which ends
  // are failures, its further names and its place.
  void adopt(ProcessId id, const ProcessSpec& spec);
  // Does so, and takes over the rest at the next start of the process. Before that, `prepare` may change the spec. The
  // name must be the same.
  void replace(ProcessId id, ProcessSpec spec, std::function<void(ProcessSpec&)> prepare);

  // By which others start helpers of a process, such as the command of a watch.
  ProcessRunner& runner() const;

  // A directory that only this user can enter. It ends with the launch, also when the launcher is killed. Throws
  // std::system_error.
  const std::string& files_directory() const;

  // Takes note of what a process that runs says of itself.
  void set_status(ProcessId id, const std::string& text);

  // Takes note of the health of a process that runs, and tells the observers. For the one who watches it.
  void set_health(ProcessId id, HealthChanged change);

  // After shutdown(): sends SIGTERM now to each process that has only got SIGINT so far. Returns the longest time until
  // one of the processes that are left gets SIGKILL.
  Duration terminate_all();

  // Sends SIGKILL to everything that is alive, now. Respawns go on unless shutdown() was called before.
  void kill_all();

  // The labels of the processes that run, and of those whose descendants hold their output open.
  std::vector<std::string> alive() const;
  // Processes that are not yet kDone.
  std::size_t active() const;
  ProcessState state(ProcessId id) const;
  ProcessView view(ProcessId id) const;

 private:
  std::unique_ptr<Supervision> impl_;  // supervised_process.hpp
};

}  // namespace launch
