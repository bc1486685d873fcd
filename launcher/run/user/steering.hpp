// SPDX-License-Identifier: Apache-2.0
// What a user may ask of a launch that runs: what its processes do, and to stop, start, restart or signal some.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/visit/process_command.hpp"

namespace launch {

// A process that the launch was asked for.
struct SteeredProcess {
  const TrackedProcess* tracked = nullptr;
  ProcessId id = 0;                 // 0: it has not been started yet
  std::string name;                 // its label; without a number before its start
  std::vector<std::string> names;   // further names for it
  bool waits = false;               // for what its `depends_on` names
  bool skipped = false;             // it will never start
  std::vector<std::string> groups;  // of the launch file around it, the outermost first
  bool scalable = false;
  bool tty = false;   // it has a terminal of its own
  bool away = false;  // its machine can't be reached now
  SourceRange origin;
};

// What has become of a request to processes.
struct SteeringOutcome {
  std::vector<std::string> done;     // the processes that got the request
  std::vector<std::string> dropped;  // those that waited for their start, and will never start now
  std::vector<std::string> refused;  // "talker-1 runs already"
  std::string error;                 // nothing was done: "no process is named 'talkr'"
  std::string help;                  // "did you mean 'talker'?"
};

class Steering {
 public:
  // Shell patterns for the label of a process ("talker-1"), the label without its number, and the names of its node.
  using Patterns = std::vector<std::string>;
  enum class Request { kStop, kStart, kRestart, kSignal };

  struct Callbacks {
    std::function<bool()> ending;  // nothing may start any more
    std::function<void()> done;    // the launch may have nothing left to run
    std::function<void(const std::string& reason)> shutdown;
    std::function<void(const std::string& text)> tell;
  };

  // The references must outlive this object.
  Steering(ProcessSupervisor& supervisor, Processes& processes, Callbacks callbacks)
      : supervisor_(supervisor), processes_(processes), callbacks_(std::move(callbacks)) {}

  // Tells whether a machine can be reached now. Without it each can.
  void use_reach(std::function<bool(const std::string& machine)> reaches) { reaches_ = std::move(reaches); }

  // In the order in which they were asked for.
  std::vector<SteeredProcess> processes() const;
  // Which processes are meant: those that a pattern matches, and those in one of the groups, also in a group within it.
  // Without both all are.
  struct Wanted {
    Patterns patterns{};
    std::vector<std::string> groups{};  // shell patterns, too
    bool empty() const { return patterns.empty() && groups.empty(); }
  };
  // Sets `error` and `help` when a pattern matches none.
  std::vector<SteeredProcess> find(const Wanted& wanted, SteeringOutcome& outcome) const;

  SteeringOutcome ask(Request request, const Wanted& wanted, int signal = 0);
  // Ends the launch as a first Ctrl-C does.
  void shutdown();
  bool is_ending() const { return callbacks_.ending(); }

  // Called when the launch begins to end, with the reason. One observer, null for none.
  void observe_end(std::function<void(const std::string& reason)> observer) { on_end_ = std::move(observer); }
  void tell_end(const std::string& reason) const {
    if (on_end_) {
      on_end_(reason);
    }
  }

  // Whether a process was stopped that may be started again. Until then the launch has something to wait for.
  bool holds() const { return !stopped_.empty(); }
  // Whether this process was stopped so.
  bool is_stopped(ProcessId id) const { return stopped_.contains(id); }
  // It need not be waited for any more.
  void forget(ProcessId id) { stopped_.erase(id); }
  void on_event(const ProcessEvent& event);

 private:
  // Returns why the request can't be carried out, or "".
  std::string carry_out(Request request, const SteeredProcess& process, int signal);
  bool reaches(const std::string& machine) const { return machine.empty() || !reaches_ || reaches_(machine); }

  ProcessSupervisor& supervisor_;
  Processes& processes_;
  Callbacks callbacks_;
  std::function<void(const std::string& reason)> on_end_;
  std::function<bool(const std::string& machine)> reaches_;
  std::set<ProcessId> stopped_;  // by ask(), and not started since
};

// "stop", "start", "restart", "signal".
const char* name_of(Steering::Request request);
// Whether a shell pattern matches one of the names of the process.
bool matches(const std::string& pattern, const SteeredProcess& process);

}  // namespace launch
