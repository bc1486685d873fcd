// SPDX-License-Identifier: Apache-2.0
// The faults of a test: each is applied to its process when its time has come.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/dependency_watches.hpp"
#include "launcher/run/processes.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

// What happens to a fault.
struct FaultEvent {
  enum class Kind {
    kApplied,
    kOver,   // it lasted for a time; for a kill, at once
    kMissed  // it could not be applied
  };
  std::size_t number = 0;  // of the fault
  Kind kind = Kind::kApplied;
  std::vector<std::string> labels = {};  // of kApplied: the processes
  int signal = 0;                        // of kApplied: what a kill has sent
  std::string reason = {};               // of kMissed: "'worker' did not run"
};

class Faults {
 public:
  // The references must outlive this object. `log` gets a line for each fault that is applied, or can't be.
  Faults(EventLoop& loop, ProcessSupervisor& supervisor, Processes& processes,
         std::function<void(const std::string&)> log);
  ~Faults();
  Faults(const Faults&) = delete;
  Faults& operator=(const Faults&) = delete;

  // Receives what happens to faults, also before a process reports its end. One observer, null for none.
  void observe(std::function<void(const FaultEvent&)> observer) { observer_ = std::move(observer); }

  // The test begins: the times of its faults count from now. Their dependencies must be resolved. Faults that are left
  // out are passed over.
  void start(std::vector<FaultRequest> faults);

  // To be called when the table has noted an event of a process.
  void on_event(const ProcessEvent& event);
  void on_skipped(const TrackedProcess& process) { watches_.on_process_event(process); }
  void on_line(ProcessId id, OutputStream stream, std::string_view line);
  // Whether some fault waits for a line.
  bool watch_output() const { return watches_.watch_output(); }

  // The shutdown begins: what stands still goes on, and nothing is applied any more.
  void shutdown();

 private:
  struct Fault;

  void decide(Fault& fault, const std::optional<std::string>& failure);
  void begin(Fault& fault);
  void apply(Fault& fault);
  // Each returns why it can't be applied to the process, or "".
  std::string apply(Fault& fault, ProcessId id, const KillFault& kill);
  std::string apply(Fault& fault, ProcessId id, const StopFault& stop);
  std::string apply(Fault& fault, ProcessId id, const SlowFault& slow);
  std::string apply(Fault& fault, ProcessId id, const LimitFault& limit);
  void turn(Fault& fault, bool runs);
  void hold(const Fault& fault, ProcessId id);
  void release(const Fault& fault, ProcessId id);
  void end(Fault& fault);
  void miss(Fault& fault, const std::string& reason);
  void tell(const Fault& fault, FaultEvent event) const;

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  Processes& processes_;
  std::function<void(const std::string&)> log_;
  std::function<void(const FaultEvent&)> observer_;
  DependencyWatches watches_;
  std::list<Fault> faults_;                           // their addresses don't change
  std::map<ProcessId, std::set<const Fault*>> held_;  // processes that stand still, and the faults that hold them
};

}  // namespace launch
