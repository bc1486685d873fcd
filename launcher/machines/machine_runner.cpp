// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/machine_runner.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <map>

namespace launch {
namespace {

class MachineRunner final : public ProcessRunner {
 public:
  MachineRunner(ProcessRunner& here, MachineConnections& machines) : here_(here), machines_(machines) {}

  Process spawn(const ProcessSpec& spec) override {
    if (spec.machine.empty()) {
      return here_.spawn(spec);
    }
    RemoteRuns* const runs = machines_.runs(spec.machine);
    if (runs == nullptr) {
      throw NeverStarts(ENOTCONN, fmt::format("there is no connection to machine '{}'", spec.machine));
    }
    return runs->start(spec);
  }

  void confirm(Process& process) override { there(process)->confirm(process); }

  bool signal_group(const Process& process, int signal) override {
    if (process.machine.empty()) {
      return here_.signal_group(process, signal);
    }
    there(process)->signal(process, signal);
    return true;
  }

  std::optional<std::uint64_t> limit(const Process& process, int resource, std::uint64_t soft) override {
    return process.machine.empty() ? here_.limit(process, resource, soft) : std::nullopt;
  }

  std::optional<SchedulingFailure> change_scheduling(const Process& process, const ResourceLimits& wanted,
                                                     GroupScheduling& before) override {
    return process.machine.empty() ? here_.change_scheduling(process, wanted, before)
                                   : ProcessRunner::change_scheduling(process, wanted, before);
  }
  std::optional<SchedulingFailure> restore_scheduling(const Process& process, const GroupScheduling& before) override {
    return process.machine.empty() ? here_.restore_scheduling(process, before)
                                   : ProcessRunner::restore_scheduling(process, before);
  }

  std::vector<bool> groups_live(const std::vector<const Process*>& leaders) override {
    std::map<std::string, std::vector<const Process*>> of_machines;
    for (const Process* const leader : leaders) {
      of_machines[leader->machine].push_back(leader);
    }
    std::map<const Process*, bool> live;
    for (const auto& [machine, some] : of_machines) {
      const std::vector<bool> answers =
          machine.empty() ? here_.groups_live(some) : there(*some.front())->groups_live(some);
      for (std::size_t i = 0; i < some.size(); ++i) {
        live[some[i]] = answers[i];
      }
    }
    std::vector<bool> all;
    for (const Process* const leader : leaders) {
      all.push_back(live[leader]);
    }
    return all;
  }

  std::vector<StoppedChild> take_stopped() override { return here_.take_stopped(); }
  void await_stop(const Process& process) override {
    if (process.machine.empty()) {
      here_.await_stop(process);
    }
  }
  bool in_foreground() const override { return here_.in_foreground(); }
  bool was_ended_by_kernel(const Process& process, Duration started) override {
    return process.machine.empty() && here_.was_ended_by_kernel(process, started);
  }
  ProcessExit outcome(const Process& process) override {
    return process.machine.empty() ? here_.outcome(process) : there(process)->outcome(process);
  }
  ProcessExit reap(const Process& process) override {
    return process.machine.empty() ? here_.reap(process) : there(process)->reap(process);
  }

 private:
  // A connection stays, even if it is lost, so it is there for each process that was asked for.
  RemoteRuns* there(const Process& process) { return machines_.runs(process.machine); }

  ProcessRunner& here_;
  MachineConnections& machines_;
};

}  // namespace

std::unique_ptr<ProcessRunner> make_machine_runner(ProcessRunner& here, MachineConnections& machines) {
  return std::make_unique<MachineRunner>(here, machines);
}

}  // namespace launch
