// SPDX-License-Identifier: Apache-2.0
// What a test of a system (`launch test`) adds to its launch: it is told what happens, its faults are applied, and it
// may change processes before they start. Without a test, nothing of this happens.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/run/system_test/faults.hpp"
#include "launcher/visit/test_request.hpp"

namespace launch {

class SystemTest {
 public:
  using LineSink = std::function<void(const ProcessSpec& spec, const std::string& label, OutputStream stream,
                                      std::string_view line)>;

  // None of them may call the launch, but for LaunchService::end().
  struct Sinks {
    std::function<void(TestRequest)> begin;  // each test of the launch file, before the processes of its round start
    LineSink line;                           // each line of each process, before the exit of the process is reported
    std::function<void()> ending;            // the shutdown begins, whatever its reason
    std::function<void(const FaultEvent&)> fault;  // what happens to the faults of the test
  };

  // The references must outlive this object. `log` gets a line for each fault that is applied, or can't be.
  SystemTest(EventLoop& loop, ProcessSupervisor& supervisor, Processes& processes,
             std::function<void(const std::string&)> log)
      : faults_(loop, supervisor, processes, std::move(log)) {}

  void use(Sinks sinks);
  // `prepare` may change each process before its first start.
  void prepare_by(std::function<void(ProcessSpec&)> prepare) { prepare_ = std::move(prepare); }
  // Of a test with faults of the network. It must outlive this object.
  void use_network(TestNetwork& network) { faults_.use_network(network); }
  // Of a test with faults of disks. They must outlive this object.
  void use_disks(TestDisks& disks) { faults_.use_disks(disks); }

  // The tests that the launch file has requested begin. The directory is for files, which end with this object.
  void begin(std::vector<TestRequest> tests, const std::string& directory);
  // A process is about to start.
  void prepare(ProcessSpec& spec, ProcessId id) const;

  // To be called when the table of processes has noted the event.
  void on_event(const ProcessEvent& event) { faults_.on_event(event); }
  void on_skipped(const TrackedProcess& process) { faults_.on_skipped(process); }
  bool watch_output() const { return sinks_.line || faults_.watch_output(); }
  void on_line(const ProcessSpec& spec, ProcessId id, const std::string& label, OutputStream stream,
               std::string_view line);

  void on_shutdown();
  // The system has ended, with a shutdown or without.
  void on_end() { faults_.shutdown(); }

 private:
  Sinks sinks_;
  std::function<void(ProcessSpec&)> prepare_;
  Faults faults_;
};

}  // namespace launch
