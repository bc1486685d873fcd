// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start/processes.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <unordered_map>
#include <utility>

#include "launcher/visit/dependency.hpp"

namespace launch {

namespace {

// Sends the command to a process that is not done.
void send(const ProcessCommand& command, ProcessId id, ProcessSupervisor& supervisor) {
  switch (command.kind) {
    case ProcessCommand::Kind::kStop:
      supervisor.stop(id);
      break;
    case ProcessCommand::Kind::kRestart:
      supervisor.restart(id);
      break;
    case ProcessCommand::Kind::kSignal:
      supervisor.signal(id, command.signal);
      break;
  }
}

}  // namespace

Processes::Processes(EventLoop& loop, ProcessSupervisor& supervisor, Callbacks callbacks)
    : supervisor_(supervisor),
      callbacks_(std::move(callbacks)),
      order_(loop, {[this](ProcessSpec spec, TrackedProcess& process) { start(std::move(spec), process); },
                    callbacks_.fail, callbacks_.tell, callbacks_.skipped, callbacks_.ready}) {}

Round Processes::enter(Requests requests) {
  Round round{std::move(requests), {}};
  for (const ProcessSpec& spec : round.requests.processes) {
    round.processes.push_back(&table_.add(spec));
  }
  resolve_dependencies(round.requests.dependencies, round.processes, table_);
  for (TestRequest& test : round.requests.tests) {
    for (FaultRequest& fault : test.faults) {
      resolve_targets(fault.dependencies, round.processes, table_);
    }
  }
  check(round.requests.commands);
  return round;
}

void Processes::execute(const ProcessCommand& command) {
  const std::vector<TrackedProcess*> named = table_.find(command.process);
  bool carried_out = false;
  for (const TrackedProcess* const process : named) {
    if (process->id == 0) {
      carried_out |= command.kind == ProcessCommand::Kind::kStop && order_.drop(*process);
    } else if (!process->is_over) {
      carried_out = true;
      send(command, process->id, supervisor_);
    }
  }
  if (carried_out) {
    return;
  }
  if (command.kind == ProcessCommand::Kind::kRestart && named.back()->id != 0) {
    supervisor_.restart(named.back()->id);
    return;
  }
  callbacks_.tell(LogLevel::kWarning, "launch",
                  fmt::format("{}: process '{}' does not run ({})", name_of(command.kind), command.process,
                              to_string(command.where)));
}

void Processes::for_each(
    const std::function<void(const TrackedProcess& process, const ProcessSpec* waiting)>& tell) const {
  const std::unordered_map<const TrackedProcess*, const ProcessSpec*> waiting = order_.waiting();
  for (const TrackedProcess& process : table_.all()) {
    const auto found = waiting.find(&process);
    tell(process, found == waiting.end() ? nullptr : found->second);
  }
}

void Processes::wait(Round& round) {
  std::vector<std::vector<Dependency>> dependencies(round.processes.size());
  for (Dependency& dependency : round.requests.dependencies) {
    dependencies[dependency.process].push_back(std::move(dependency));
  }
  for (std::size_t i = 0; i < round.processes.size(); ++i) {
    if (!dependencies[i].empty()) {
      order_.add(std::move(round.requests.processes[i]), *round.processes[i], std::move(dependencies[i]));
      round.processes[i] = nullptr;
    }
  }
}

void Processes::start(Round& round) {
  for (std::size_t i = 0; i < round.processes.size(); ++i) {
    if (round.processes[i] != nullptr && !shut_down_) {
      start(std::move(round.requests.processes[i]), *round.processes[i]);
    }
  }
}

void Processes::shutdown() {
  shut_down_ = true;
  order_.clear();
}

void Processes::start_last(ProcessSpec spec) {
  spec.respawn.enabled = false;
  spec.shutdown_on_exit = spec.required = false;
  TrackedProcess& process = table_.add(spec);
  start(std::move(spec), process);
}

void Processes::start(ProcessSpec spec, TrackedProcess& process) {
  const ProcessId id = supervisor_.next_id();
  table_.bind(process, id, fmt::format("{}-{}", spec.name, id));
  callbacks_.starting(spec, id);
  supervisor_.start(std::move(spec));
}

void Processes::on_event(const ProcessEvent& event) {
  if (TrackedProcess* const process = table_.note(event)) {
    order_.on_process_event(*process);
  }
}

void Processes::on_line(ProcessId id, OutputStream stream, std::string_view line) {
  if (TrackedProcess* const process = order_.watch_output() ? table_.find(id) : nullptr) {
    order_.on_line(*process, stream, line);
  }
}

}  // namespace launch
