// SPDX-License-Identifier: Apache-2.0
// The faults of processes: a process is killed, stands still, runs slowly or gets limits. The time of a clock stands
// still, jumps or has another rate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

class ProcessFaults {
 public:
  // The references must outlive this object.
  ProcessFaults(EventLoop& loop, ProcessSupervisor& supervisor) : loop_(loop), supervisor_(supervisor) {}

  // Applies the fault to these processes, all of which run. Returns why it can't be applied to one of them, or "". Must
  // not be called again for a fault before end().
  std::string apply(const FaultRequest& fault, const std::vector<ProcessId>& processes);
  // Its time is over: what it has changed is as it was before.
  void end(const FaultRequest& fault);

  // A run of the process has ended. The next one is free.
  void on_exit(ProcessId process);
  // What stands still goes on, and nothing is slow any more.
  void shutdown();

 private:
  // A soft limit of a process as it was.
  struct Limit {
    ProcessId process;
    int resource;
    std::uint64_t before;
  };
  struct Applied {
    std::vector<ProcessId> processes;
    std::vector<Limit> limits;
    EventLoop::SourcePtr turn;  // of slow processes
  };

  std::string apply_to(ProcessId process, const FaultRequest& fault, Applied& applied);
  // False if a limit can't be set.
  bool limit(ProcessId process, const LimitFault& limits, Applied& applied);
  void turn(std::size_t number, unsigned percent, bool runs);
  void hold(std::size_t number, ProcessId process);
  void release(std::size_t number, ProcessId process);

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  std::map<std::size_t, Applied> applied_;           // by the number of a fault
  std::map<ProcessId, std::set<std::size_t>> held_;  // processes that stand still, and the faults that hold them
};

}  // namespace launch
