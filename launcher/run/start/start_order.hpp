// SPDX-License-Identifier: Apache-2.0
// Processes that wait for others, or for something outside, before they start (`depends_on`).
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/process/event_loop.hpp"
#include "launcher/run/start/dependency_watches.hpp"
#include "launcher/visit/dependency.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

class StartOrder {
 public:
  // Each is called from a turn of the loop of its own.
  struct Callbacks {
    std::function<void(ProcessSpec spec, TrackedProcess& process)> start;
    // A process won't start, and the launch must end.
    std::function<void(const LaunchError&)> fail;
    std::function<void(LogLevel level, const std::string& process, const std::string& text)> tell;
    // A process won't start, and the launch goes on without it.
    std::function<void(const TrackedProcess& process)> skipped;
    // The condition that the process waits for holds. Called at once, before `start`.
    std::function<void(const std::string& process, const Dependency& dependency)> holds;
  };

  // The loop must outlive this object.
  StartOrder(EventLoop& loop, Callbacks callbacks) : loop_(loop), callbacks_(std::move(callbacks)), watches_(loop) {}

  // The process starts when all its dependencies hold. There must be at least one, and all must be resolved.
  void add(ProcessSpec spec, TrackedProcess& process, std::vector<Dependency> dependencies);

  // To be called when the table has noted an event of the process.
  void on_process_event(TrackedProcess& process);
  void on_line(TrackedProcess& process, OutputStream stream, std::string_view line);

  // The process must never start. Returns whether it waited.
  bool drop(const TrackedProcess& process);
  // Forgets a process that waits, without a word to those that wait for it.
  void withdraw(const TrackedProcess& process);
  // The processes for which it waits.
  std::vector<const TrackedProcess*> targets(const TrackedProcess& process) const;
  // No process must start any more.
  void clear();

  bool empty() const { return waiting_.empty(); }
  // The processes that wait, and what shall start.
  std::unordered_map<const TrackedProcess*, const ProcessSpec*> waiting() const;
  // Whether some process waits for a line.
  bool watch_output() const { return watches_.watch_output(); }

 private:
  struct Waiting;
  struct Watch {
    Dependency dependency;
    Waiting* owner;
    DependencyWatches::WatchPtr watch{};
    bool settled = false;  // the condition holds, or its failure has been handled
    std::optional<std::string> failure{};
  };
  struct Waiting : std::enable_shared_from_this<Waiting> {
    Waiting(ProcessSpec given, TrackedProcess& asked_for) : spec(std::move(given)), process(&asked_for) {}

    ProcessSpec spec;
    TrackedProcess* process;
    std::list<std::shared_ptr<Waiting>>::iterator place{};  // in waiting_
    std::list<Watch> watches{};                             // their addresses don't change
    std::size_t open = 0;                                   // watches that are not settled
    bool ended = false;
  };
  using WaitingPtr = std::shared_ptr<Waiting>;

  void decide(Watch& watch, const std::optional<std::string>& failure);
  void proceed_later(Waiting& waiting);
  void proceed();
  void deal_with_failures(const WaitingPtr& waiting);
  void end(Waiting& waiting);

  EventLoop& loop_;
  Callbacks callbacks_;
  DependencyWatches watches_;
  std::list<WaitingPtr> waiting_;
  std::vector<WaitingPtr> changed_;  // those with a watch that was settled or failed since proceed()
};

}  // namespace launch
