// SPDX-License-Identifier: Apache-2.0
// The processes of a launch, by name: each starts when its conditions hold, and gets the commands that name it.
//
// A round of many processes starts in slices, so that signals and control are served meanwhile.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/conditions/process_usage_watch.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/start/rounds.hpp"
#include "launcher/run/start/start_order.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

class Processes {
 public:
  // After so much time the start of a round lets the loop do what is due.
  static constexpr Duration kSlice = std::chrono::milliseconds(10);

  struct Callbacks {
    // A process with this number is about to start. Its spec may still be changed.
    std::function<void(ProcessSpec& spec, ProcessId id)> starting;
    // A process won't start, and the launch must end.
    std::function<void(const LaunchError&)> fail;
    // `logger` is the name of a process, or "launch".
    std::function<void(LogLevel level, const std::string& logger, const std::string& text)> tell;
    // A process won't start, and the launch goes on without it.
    std::function<void(const TrackedProcess& process)> skipped;
    // The condition that the process waits for holds.
    std::function<void(const std::string& process, const Dependency& dependency)> ready;
  };

  // The references must outlive this object.
  Processes(EventLoop& loop, ProcessSupervisor& supervisor, Callbacks callbacks);

  // Makes the names of the processes of a traversal known. Throws LaunchError when its dependencies or commands name no
  // process, or when no process can start first.
  Round enter(Requests requests);
  // Throws LaunchError for names that no process has.
  void check(const std::vector<ProcessCommand>& commands) const { check_commands(commands, table_); }
  // The processes of this name, in the order in which they were asked for.
  std::vector<TrackedProcess*> find(const std::string& name) const { return table_.find(name); }
  // Those of them that run on this machine.
  std::vector<ProcessUsageWatch::Running> running(const std::string& name) const;
  // All names that the launch file knows.
  std::vector<std::string> names() const { return table_.names(); }
  // Null if the process was not asked for by a launch file.
  TrackedProcess* find(ProcessId id) { return table_.find(id); }
  // Takes the commands of the round for what actions start in the round itself, to be carried out when it has started.
  [[nodiscard]] std::vector<ProcessCommand> take_later(Round& round) const;
  // Carries out a command. Reports a command that no process could get.
  void execute(const ProcessCommand& command);
  // Another reading of the launch file says this of the process: it has other names, and what is no matter of its start
  // holds at once. With replace() the rest holds from its next start on.
  void adopt(TrackedProcess& process, const ProcessSpec& spec);
  void replace(TrackedProcess& process, ProcessSpec spec);
  // The launch file has it no longer: no name means it any more. One that waits never starts; nobody is told.
  void forget(TrackedProcess& process);
  // What a scalable process has been started with last, before anything was added to it; null if it is not scalable.
  const ProcessSpec* scalable(const TrackedProcess& process) const;
  // The processes for which it waits.
  std::vector<const TrackedProcess*> targets(const TrackedProcess& process) const { return order_.targets(process); }
  // The process must never start. Returns whether it waited.
  bool drop(const TrackedProcess& process);
  // In the order in which they were asked for. `waiting` is null for a process that does not wait for something, nor
  // for its turn.
  void for_each(const std::function<void(const TrackedProcess& process, const ProcessSpec* waiting)>& tell) const;

  // The processes of a round that wait for something begin to wait. They watch the others from their start on, so this
  // must be called before start().
  void wait(Round& round);
  // Starts the other processes, unless the shutdown comes before, and calls `started` then: before this returns, or in
  // a later turn of the loop. The round must stay where it is until then. What its processes wait for may happen
  // meanwhile; those start behind the others.
  void start(Round& round, EventLoop::Callback started);
  // Processes that still wait never start, and start() does nothing after this.
  void shutdown();
  // For on_shutdown handlers: starts a process that runs once, whatever its spec says.
  void start_last(ProcessSpec spec);

  void on_event(const ProcessEvent& event);
  void on_line(ProcessId id, OutputStream stream, std::string_view line);
  // Whether some process waits for a line of another one.
  bool watch_output() const { return order_.watch_output(); }
  // Whether some process waits for something before it starts.
  bool waiting() const { return !order_.empty(); }

 private:
  // A round whose processes are being started.
  struct Starting {
    Round& round;
    EventLoop::Callback started;
    std::size_t next = 0;
    std::vector<std::pair<ProcessSpec, TrackedProcess*>> behind{};
  };

  void start(ProcessSpec spec, TrackedProcess& process);
  void note_scalable(const TrackedProcess& process, const ProcessSpec& spec);
  void start_slice();

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  Callbacks callbacks_;
  ProcessTable table_;
  StartOrder order_;
  std::map<const TrackedProcess*, ProcessSpec> scalable_;
  std::optional<Starting> starting_;
  bool shut_down_ = false;
};

}  // namespace launch
