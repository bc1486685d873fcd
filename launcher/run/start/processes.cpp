// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/start/processes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
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
    case ProcessCommand::Kind::kSetPriority:
      supervisor.change_scheduling(id, command.scheduling);
      break;
    case ProcessCommand::Kind::kRestorePriority:
      supervisor.restore_scheduling(id);
      break;
  }
}

}  // namespace

Processes::Processes(EventLoop& loop, ProcessSupervisor& supervisor, Callbacks callbacks)
    : loop_(loop),
      supervisor_(supervisor),
      callbacks_(std::move(callbacks)),
      order_(loop, {[this](ProcessSpec spec, TrackedProcess& process) {
                      if (starting_) {
                        starting_->behind.emplace_back(std::move(spec), &process);
                      } else {
                        start(std::move(spec), process);
                      }
                    },
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

std::vector<ProcessUsageWatch::Running> Processes::running(const std::string& name) const {
  std::vector<ProcessUsageWatch::Running> running;
  for (const TrackedProcess* const process : table_.find(name)) {
    if (process->id == 0) {
      continue;
    }
    const ProcessView view = supervisor_.view(process->id);
    if (view.pid > 0 && view.spec.machine.empty()) {
      running.push_back({view.label, view.pid});
    }
  }
  return running;
}

std::vector<ProcessCommand> Processes::take_later(Round& round) const {
  const auto starts_now = [&](const ProcessCommand& command) {
    const std::vector<TrackedProcess*> named = table_.find(command.process);
    return command.of_action && std::any_of(named.begin(), named.end(), [&](TrackedProcess* process) {
             return std::find(round.processes.begin(), round.processes.end(), process) != round.processes.end();
           });
  };
  std::vector<ProcessCommand>& commands = round.requests.commands;
  const auto first = std::stable_partition(commands.begin(), commands.end(), std::not_fn(starts_now));
  std::vector<ProcessCommand> later(std::make_move_iterator(first), std::make_move_iterator(commands.end()));
  commands.erase(first, commands.end());
  return later;
}

void Processes::execute(const ProcessCommand& command) {
  const std::vector<TrackedProcess*> named = table_.find(command.process);
  if (named.empty()) {
    callbacks_.tell(
        LogLevel::kWarning, "launch",
        fmt::format("{}: the action has started no process ({})", name_of(command.kind), to_string(command.where)));
    return;
  }
  bool carried_out = false;
  for (const TrackedProcess* const process : named) {
    if (process->id == 0) {
      carried_out |= command.kind == ProcessCommand::Kind::kStop && drop(*process);
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
  std::unordered_map<const TrackedProcess*, const ProcessSpec*> waiting = order_.waiting();
  if (starting_) {
    for (std::size_t i = starting_->next; i < starting_->round.processes.size(); ++i) {
      waiting.emplace(starting_->round.processes[i], &starting_->round.requests.processes[i]);
    }
    for (const auto& [spec, process] : starting_->behind) {
      waiting.emplace(process, &spec);
    }
  }
  for (const TrackedProcess& process : table_.all()) {
    if (process.is_gone && (process.is_over || process.id == 0)) {
      continue;
    }
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

void Processes::start(Round& round, EventLoop::Callback started) {
  starting_.emplace(Starting{round, std::move(started)});
  start_slice();
}

void Processes::start_slice() {
  const Duration end = loop_.now() + kSlice;
  Round& round = starting_->round;
  while (starting_->next < round.processes.size() && !shut_down_) {
    if (loop_.now() >= end) {
      loop_.post([this] { start_slice(); });
      return;
    }
    const std::size_t i = starting_->next++;
    if (round.processes[i] != nullptr) {
      start(std::move(round.requests.processes[i]), *round.processes[i]);
    }
  }
  Starting over = *std::exchange(starting_, std::nullopt);
  for (auto& [spec, process] : over.behind) {
    if (!shut_down_ && !process->is_over) {
      start(std::move(spec), *process);
    }
  }
  over.started();
}

void Processes::adopt(TrackedProcess& process, const ProcessSpec& spec) {
  table_.rename(process, spec);
  note_scalable(process, spec);
  if (process.id != 0) {
    supervisor_.adopt(process.id, spec);
  }
}

void Processes::replace(TrackedProcess& process, ProcessSpec spec) {
  table_.rename(process, spec);
  note_scalable(process, spec);
  supervisor_.replace(process.id, std::move(spec),
                      [this, id = process.id](ProcessSpec& next) { callbacks_.starting(next, id); });
}

void Processes::forget(TrackedProcess& process) {
  order_.withdraw(process);
  table_.forget(process);
  scalable_.erase(&process);
}

const ProcessSpec* Processes::scalable(const TrackedProcess& process) const {
  const auto found = scalable_.find(&process);
  return found == scalable_.end() ? nullptr : &found->second;
}

void Processes::note_scalable(const TrackedProcess& process, const ProcessSpec& spec) {
  if (spec.scalable) {
    scalable_.insert_or_assign(&process, spec);
  } else {
    scalable_.erase(&process);
  }
}

bool Processes::drop(const TrackedProcess& process) {
  if (starting_) {
    std::vector<TrackedProcess*>& all = starting_->round.processes;
    const auto found = std::find(all.begin() + static_cast<std::ptrdiff_t>(starting_->next), all.end(), &process);
    const auto behind = std::find_if(starting_->behind.begin(), starting_->behind.end(),
                                     [&](const auto& each) { return each.second == &process && !process.is_over; });
    TrackedProcess* const dropped = found != all.end()                  ? std::exchange(*found, nullptr)
                                    : behind != starting_->behind.end() ? behind->second
                                                                        : nullptr;
    if (dropped != nullptr) {
      dropped->is_over = true;
      order_.on_process_event(*dropped);
      callbacks_.skipped(*dropped);
      return true;
    }
  }
  return order_.drop(process);
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
  note_scalable(process, spec);
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
