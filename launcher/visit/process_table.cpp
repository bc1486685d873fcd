// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/process_table.hpp"

#include <algorithm>
#include <variant>

namespace launch {

std::vector<std::string> names_of(const ProcessSpec& spec) {
  std::vector<std::string> names = {spec.name};
  for (const std::string& name : spec.other_names) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  }
  return names;
}

TrackedProcess& ProcessTable::add(const ProcessSpec& spec) {
  TrackedProcess& process = processes_.emplace_back();
  process.names = names_of(spec);
  process.is_watched = !spec.watches.empty();
  for (const std::string& name : process.names) {
    by_name_[name].push_back(&process);
  }
  return process;
}

void ProcessTable::rename(TrackedProcess& process, const ProcessSpec& spec) {
  process.is_watched = !spec.watches.empty();
  std::vector<std::string> names = names_of(spec);
  if (names == process.names) {
    return;
  }
  for (const std::string& name : process.names) {
    std::erase(by_name_[name], &process);
  }
  process.names = std::move(names);
  for (const std::string& name : process.names) {
    by_name_[name].push_back(&process);
  }
}

void ProcessTable::forget(TrackedProcess& process) {
  process.is_gone = true;
  for (const std::string& name : process.names) {
    if (const auto found = by_name_.find(name);
        found != by_name_.end() && std::erase(found->second, &process) != 0 && found->second.empty()) {
      by_name_.erase(found);
    }
  }
  std::erase_if(by_label_, [&](const auto& entry) { return entry.second == &process; });
}

void ProcessTable::bind(TrackedProcess& process, ProcessId id, const std::string& label) {
  process.id = id;
  by_id_.emplace(id, &process);
  by_label_.emplace(label, &process);
}

TrackedProcess* ProcessTable::note(const ProcessEvent& event) {
  TrackedProcess* const process = find(event.id);
  if (process == nullptr) {
    return nullptr;
  }
  if (std::holds_alternative<ProcessStarted>(event.what)) {
    process->has_run = true;
    process->is_over = false;
  } else if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    process->exit_code = exited->exit.code;
    process->is_healthy = false;
  } else if (const auto* const change = std::get_if<HealthChanged>(&event.what)) {
    process->is_healthy = change->health == Health::kHealthy;
  } else if (std::holds_alternative<ProcessDone>(event.what)) {
    process->is_over = true;
  }
  return process;
}

TrackedProcess* ProcessTable::find(ProcessId id) {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : found->second;
}

std::vector<TrackedProcess*> ProcessTable::find(const std::string& name) const {
  if (const auto named = by_name_.find(name); named != by_name_.end() && !named->second.empty()) {
    return named->second;
  }
  const auto labelled = by_label_.find(name);
  return labelled == by_label_.end() ? std::vector<TrackedProcess*>() : std::vector{labelled->second};
}

std::vector<std::string> ProcessTable::names() const {
  std::vector<std::string> names;
  for (const auto& [name, processes] : by_name_) {
    if (!processes.empty()) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace launch
