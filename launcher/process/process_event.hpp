// SPDX-License-Identifier: Apache-2.0
// The events of a supervised process, for its observers.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/diagnostics/source.hpp"
#include "base/processes/ending_signals.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_runner.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

enum class ProcessState { kStarting, kRunning, kInterrupting, kTerminating, kKilling, kRespawnDelay, kDone };

// What is known of the health of a process that runs.
enum class Health {
  kUnwatched,  // also of a process that does not run
  kStarting,   // nothing yet
  kHealthy,
  kUnhealthy
};
// "unwatched", "starting", "healthy", "unhealthy".
const char* name_of(Health health);

struct ProcessStarted {
  pid_t pid;
  bool lacks_terminal = false;  // its spec wants the terminal, and the launcher has none as standard input
};
struct ProcessStartFailed {
  std::string reason;  // "no program 'talkr' in the PATH of the process: No such file or directory"
  bool will_respawn = false;
};
struct ProcessExited {
  pid_t pid;
  ProcessExit exit;
  bool expected;  // a signal of ours, or shutdown, had been sent
  bool will_respawn;
};
struct SignalSent {
  int signal;
  // Set when this signal follows one that did not work: the earlier signal and how long we waited.
  int escalated_from = 0;
  Duration waited{0};
};
// Its threads get processors in another way from now on, or as before.
struct SchedulingChanged {
  std::vector<std::string> to;  // "nice 5", "cpus 0"; empty: as before
  std::string failure = {};  // not empty: the kernel has refused it, and why; to give back what there was, for a part
};
// SIGKILL has not ended it: it is left as it is, and ProcessDone follows.
struct ProcessLeft {
  pid_t pid;
  bool foreign;  // it belongs to another user; else it hangs in the kernel, or its leader belongs to another user
};
// It has ended so often at once that it is started again more and more slowly. Told once for each such series.
struct RespawnSlowed {
  int runs;
};
// It has read the terminal, or wanted to set its modes, and the system has stopped it: only programs in the foreground
// may do so. It goes on when it gets SIGCONT.
struct ProcessWaitsForTerminal {
  pid_t pid;
  bool reads;         // else it sets modes
  bool has_terminal;  // its spec wants the terminal: it waits until the launch is in the foreground again
};
struct HealthChanged {
  Health health;
  Health before;
  std::string reason;  // of kUnhealthy: "a timer callback has run for 5.1 s"
  SourceRange where;   // the watch that has found it
  pid_t pid = -1;      // the supervisor sets it
};
// It has been started as often as its limit allows.
struct StartLimitReached {
  std::int64_t starts;
  Duration within;
  std::optional<Duration> cool_down;  // until the next start; nullopt: there is none
};
struct ProcessDone {};  // will not run again

// `spec` and `label` stay valid as long as the supervisor.
struct ProcessEvent {
  ProcessId id;
  const std::string& label;
  const ProcessSpec& spec;
  std::variant<ProcessStarted, ProcessStartFailed, ProcessExited, SignalSent, SchedulingChanged, ProcessLeft,
               RespawnSlowed, ProcessWaitsForTerminal, HealthChanged, StartLimitReached, ProcessDone>
      what;
};

// The label of a process as its lines have it: "arm:talker-1" on machine arm, "talker-1" on this one.
inline std::string shown_label_of(const std::string& label, const ProcessSpec& spec) {
  return spec.machine.empty() ? label : spec.machine + ":" + label;
}

// Whether the process has ended as it should not: by itself, by a crash while it was being ended, or unseen because the
// connection to its machine is lost. Ends that its spec allows are right.
inline bool has_failed(const ProcessSpec& spec, const ProcessExited& exited) {
  return exited.exit.lost ||
         ((!exited.expected || tells_of_a_crash(-exited.exit.code)) && !spec.allowed_exits.contains(exited.exit.code));
}

using ProcessOutputObserver = std::function<void(const ProcessSpec& spec, ProcessId id, const std::string& label,
                                                 OutputStream stream, std::string_view line)>;

}  // namespace launch
