// SPDX-License-Identifier: Apache-2.0
// The faults of a test: each is applied to its process, to messages, the network or a disk, when its time has come.
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
#include "launcher/run/start/dependency_watches.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/run/system_test/message_faults.hpp"
#include "launcher/run/system_test/test_disks.hpp"
#include "launcher/run/system_test/test_network.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

// What happens to a fault.
struct FaultEvent {
  enum class Kind {
    kApplied,  // of messages: for the first time, or again
    kOver,     // it lasted for a time; for a kill, at once
    kMissed    // it could not be applied
  };
  std::size_t number = 0;  // of the fault
  Kind kind = Kind::kApplied;
  std::vector<std::string> labels = {};       // of kApplied: the processes
  int signal = 0;                             // of kApplied: what a kill has sent
  std::string reason = {};                    // of kMissed: "'worker' did not run"
  std::uint64_t messages = 0;                 // of kApplied: how many have been hit so far
  Duration first{0};                          // of kApplied, with messages: when the first one was, as EventLoop::now()
  Duration latest{0};                         // and the latest one
  std::optional<std::uint64_t> packets = {};  // of kOver: how many a fault of the network has hit
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
  // Each returns why it can't be applied to the process, or "".
  std::string apply(Fault& fault, ProcessId id, const KillFault& kill);
  std::string apply(Fault& fault, ProcessId id, const StopFault& stop);
  std::string apply(Fault& fault, ProcessId id, const SlowFault& slow);
  std::string apply(Fault& fault, ProcessId id, const LimitFault& limit);
  void apply_to_messages(Fault& fault);
  void on_messages(Fault& fault);
  void end_messages(Fault& fault, const char* when);
  void apply_to_network(Fault& fault);
  void end_network(Fault& fault);
  void apply_to_disk(Fault& fault);
  void end_disk(Fault& fault);
  std::string apply(Fault& fault, ProcessId id, const ClockFault& clock);
  void go_on(const Fault& fault) const;
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
  MessageFaults messages_;
  TestNetwork* network_ = nullptr;
  TestDisks* disks_ = nullptr;
  std::list<Fault> faults_;                           // their addresses don't change
  std::map<ProcessId, std::set<const Fault*>> held_;  // processes that stand still, and the faults that hold them
};

}  // namespace launch
