// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/user/scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace launch {
namespace {

constexpr std::string_view kNodeRule = "__node:=";

bool names_node(const ProcessSpec& spec) {
  return std::any_of(spec.argv.begin(), spec.argv.end(),
                     [](const std::string& word) { return word.starts_with(kNodeRule); });
}

std::vector<std::string> names_of(const Processes& processes) {
  std::vector<std::string> names;
  processes.for_each([&](const TrackedProcess& process, const ProcessSpec*) {
    names.insert(names.end(), process.names.begin(), process.names.end());
  });
  return names;
}

SteeringOutcome refused(std::string error, std::string help = {}) {
  SteeringOutcome outcome;
  outcome.error = std::move(error);
  outcome.help = std::move(help);
  return outcome;
}

}  // namespace

ProcessSpec copy_of(const ProcessSpec& spec, std::size_t number) {
  ProcessSpec copy = spec;
  const std::string suffix = fmt::format("_{}", number);
  copy.name += suffix;
  copy.python_action.clear();
  copy.scalable = false;
  copy.environment.insert_or_assign("LAUNCH_INSTANCE", std::to_string(number));
  if (!names_node(spec)) {
    copy.other_names.clear();
    return copy;
  }
  for (std::string& word : copy.argv) {
    word += word.starts_with(kNodeRule) ? suffix : "";
  }
  std::erase(copy.other_names, spec.python_action);
  for (GeneratedFile& file : copy.files) {
    const std::string key = file.content.substr(0, file.content.find('\n'));
    if (std::any_of(copy.other_names.begin(), copy.other_names.end(),
                    [&](const std::string& name) { return key == name + ":"; })) {
      file.content.insert(key.size() - 1, suffix);
    }
  }
  for (std::string& name : copy.other_names) {
    name += suffix;
  }
  return copy;
}

SteeringOutcome Scaling::scale(const std::string& name, std::size_t count) {
  const std::vector<TrackedProcess*> found = processes_.find(name);
  if (found.empty()) {
    return refused(fmt::format("no process is named '{}'", name), did_you_mean(name, names_of(processes_)));
  }
  if (found.size() > 1) {
    return refused(fmt::format("{} processes are named '{}'", found.size(), name),
                   "name one of them, as launch ps does");
  }
  const TrackedProcess& process = *found.front();
  const ProcessSpec* const spec = processes_.scalable(process);
  if (process.id == 0) {
    return refused(fmt::format("'{}' has not been started yet", name));
  }
  if (spec == nullptr) {
    const bool is_copy = std::any_of(copies_.begin(), copies_.end(), [&](const auto& entry) {
      return std::find(entry.second.begin(), entry.second.end(), &process) != entry.second.end();
    });
    return refused(is_copy ? fmt::format("'{}' is a copy itself", name)
                           : fmt::format("'{}' is not declared scalable ({})", name,
                                         to_string(supervisor_.view(process.id).spec.origin)),
                   is_copy ? "" : "write scalable=\"true\" there if several of it can run side by side");
  }
  SteeringOutcome outcome;
  std::vector<TrackedProcess*>& copies = copies_[&process];
  while (copies.size() + 1 > count) {
    outcome.done.push_back(supervisor_.view(copies.back()->id).label);
    end(*copies.back());
    copies.pop_back();
  }
  Requests requests;
  for (std::size_t number = copies.size() + 2; number <= count; ++number) {
    requests.processes.push_back(copy_of(*spec, number));
    outcome.done.push_back(requests.processes.back().name);
  }
  const std::vector<ProcessSpec> started = requests.processes;
  if (!started.empty()) {
    start_(std::move(requests));
  }
  for (const ProcessSpec& copy : started) {
    if (const std::vector<TrackedProcess*> all = processes_.find(copy.name); !all.empty()) {
      copies.push_back(all.back());
    }
  }
  return outcome;
}

void Scaling::end(TrackedProcess& copy) {
  processes_.forget(copy);
  if (copy.id != 0 && !copy.is_over) {
    ProcessSpec quiet = supervisor_.view(copy.id).spec;
    quiet.required = quiet.shutdown_on_exit = false;
    supervisor_.adopt(copy.id, quiet);
    supervisor_.stop(copy.id);
  }
}

void Scaling::end_copies(const TrackedProcess& of) {
  if (auto copies = copies_.extract(&of)) {
    std::for_each(copies.mapped().begin(), copies.mapped().end(), [this](TrackedProcess* copy) { end(*copy); });
  }
}

void Scaling::replace_copies(const TrackedProcess& of) {
  const auto found = copies_.find(&of);
  const ProcessSpec* const spec = processes_.scalable(of);
  if (found == copies_.end()) {
    return;
  }
  if (spec == nullptr) {
    end_copies(of);
    return;
  }
  for (std::size_t i = 0; i < found->second.size(); ++i) {
    processes_.replace(*found->second[i], copy_of(*spec, i + 2));
    supervisor_.restart(found->second[i]->id);
  }
}

}  // namespace launch
