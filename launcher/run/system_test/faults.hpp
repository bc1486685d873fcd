// SPDX-License-Identifier: Apache-2.0
// The faults of a test: when each of them is applied and ends, and what the test is told of it. Parts apply them to
// processes, messages, the network and disks.
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/start/dependency_watches.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/run/system_test/fault_event.hpp"
#include "launcher/run/system_test/message_faults.hpp"
#include "launcher/run/system_test/process_faults.hpp"
#include "launcher/run/system_test/test_disks.hpp"
#include "launcher/run/system_test/test_network.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

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

  // The network that faults of the network are applied to. It must outlive this object.
  void use_network(TestNetwork& network) { network_ = &network; }

  // The disks that faults of disks are applied to. They must outlive this object.
  void use_disks(TestDisks& disks) { disks_ = &disks; }

  // The test begins: the times of its faults count from now. Their dependencies must be resolved. Faults that are left
  // out are passed over. Must be called before its processes start. The directory is for files, which end with this
  // object.
  void start(std::vector<FaultRequest> faults, const std::string& directory);
  // Tells the process, which is about to start, of faults that it applies itself.
  void prepare(ProcessSpec& spec, ProcessId id) const { messages_.prepare(spec, id); }

  // To be called when the table has noted an event of a process.
  void on_event(const ProcessEvent& event);
  void on_skipped(const TrackedProcess& process) { watches_.on_process_event(process); }
  void on_line(ProcessId id, OutputStream stream, std::string_view line);
  // Whether some fault waits for a line.
  bool watch_output() const { return watches_.watch_output(); }

  // The shutdown begins, or the system has ended: what stands still goes on, and nothing is applied any more.
  void shutdown();

 private:
  struct Fault;

  void decide(Fault& fault, const std::optional<std::string>& failure);
  void begin(Fault& fault);
  void apply(Fault& fault);
  void apply_to_processes(Fault& fault);
  void apply_to_messages(Fault& fault);
  void apply_to_network(Fault& fault);
  void apply_to_disk(Fault& fault);
  void await_end(Fault& fault);
  void end(Fault& fault);
  void on_messages(Fault& fault);
  void end_messages(Fault& fault, const char* when);
  void end_network(Fault& fault);
  void end_disk(Fault& fault);
  void log_begin(const Fault& fault) const;
  void miss(Fault& fault, const std::string& reason);
  void tell(const Fault& fault, FaultEvent event) const;

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  Processes& processes_;
  std::function<void(const std::string&)> log_;
  std::function<void(const FaultEvent&)> observer_;
  DependencyWatches watches_;
  ProcessFaults process_faults_;
  MessageFaults messages_;
  TestNetwork* network_ = nullptr;
  TestDisks* disks_ = nullptr;
  std::list<Fault> faults_;  // their addresses don't change
};

}  // namespace launch
