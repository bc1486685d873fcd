// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/user/steering.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {
namespace {

// Whether the process is in a group of this name, or in a group within it.
bool is_in(const std::string& group, const SteeredProcess& process) {
  return std::any_of(process.groups.begin(), process.groups.end(),
                     [&](const std::string& name) { return ::fnmatch(group.c_str(), name.c_str(), 0) == 0; });
}

}  // namespace

const char* name_of(Steering::Request request) {
  switch (request) {
    case Steering::Request::kStop:
      return "stop";
    case Steering::Request::kStart:
      return "start";
    case Steering::Request::kRestart:
      return "restart";
    case Steering::Request::kSignal:
      return "signal";
  }
  return "";
}

bool has_name(const std::string& name, const SteeredProcess& process) {
  return process.name == name || std::find(process.names.begin(), process.names.end(), name) != process.names.end();
}

bool matches(const std::string& pattern, const SteeredProcess& process) {
  if (has_name(pattern, process)) {
    return true;  // whatever characters it has
  }
  const auto hits = [&](const std::string& name) { return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0; };
  return hits(process.name) || std::any_of(process.names.begin(), process.names.end(), hits);
}

std::vector<SteeredProcess> Steering::processes() const {
  std::vector<SteeredProcess> all;
  processes_.for_each([&](const TrackedProcess& tracked, const ProcessSpec* waiting) {
    SteeredProcess& process = all.emplace_back();
    process.tracked = &tracked;
    process.id = tracked.id;
    process.names = tracked.names;
    process.name = tracked.names.front();
    const ProcessSpec* spec = waiting;
    if (tracked.id != 0) {
      const ProcessView view = supervisor_.view(tracked.id);
      process.name = view.label;
      spec = &view.spec;
    } else {
      process.waits = waiting != nullptr;
      process.skipped = waiting == nullptr;
    }
    if (spec != nullptr) {
      process.origin = spec->origin;
      process.groups = spec->groups;
      process.scalable = spec->scalable;
      process.tty = spec->tty;
      process.away = !reaches(spec->machine);
    }
  });
  return all;
}

std::vector<SteeredProcess> Steering::find(const Wanted& wanted, SteeringOutcome& outcome) const {
  std::vector<SteeredProcess> all = processes();
  for (const std::string& group : wanted.groups) {
    if (std::none_of(all.begin(), all.end(), [&](const auto& process) { return is_in(group, process); })) {
      std::vector<std::string> names;
      for (const SteeredProcess& process : all) {
        names.insert(names.end(), process.groups.begin(), process.groups.end());
      }
      outcome.error = fmt::format("no group with processes is named '{}'", group);
      outcome.help = names.empty() ? "<group name=\"…\"> of the launch file names one" : did_you_mean(group, names);
      return {};
    }
  }
  // The name of a process may hold characters of a pattern. Then it means this process alone.
  std::vector<std::string> exact;
  for (const std::string& pattern : wanted.patterns) {
    if (std::any_of(all.begin(), all.end(), [&](const auto& process) { return has_name(pattern, process); })) {
      exact.push_back(pattern);
    }
  }
  const auto is_meant = [&exact](const std::string& pattern, const SteeredProcess& process) {
    return std::find(exact.begin(), exact.end(), pattern) != exact.end() ? has_name(pattern, process)
                                                                         : matches(pattern, process);
  };
  for (const std::string& pattern : wanted.patterns) {
    if (std::none_of(all.begin(), all.end(), [&](const auto& process) { return is_meant(pattern, process); })) {
      std::vector<std::string> names;
      for (const SteeredProcess& process : all) {
        names.push_back(process.name);
        names.insert(names.end(), process.names.begin(), process.names.end());
      }
      outcome.error = fmt::format("no process is named '{}'", pattern);
      outcome.help = did_you_mean(pattern, names);
      return {};
    }
  }
  if (!wanted.empty()) {
    std::erase_if(all, [&](const SteeredProcess& process) {
      return std::none_of(wanted.patterns.begin(), wanted.patterns.end(),
                          [&](const std::string& pattern) { return is_meant(pattern, process); }) &&
             std::none_of(wanted.groups.begin(), wanted.groups.end(),
                          [&](const std::string& group) { return is_in(group, process); });
    });
  }
  return all;
}

SteeringOutcome Steering::ask(Request request, const Wanted& wanted, int signal) {
  SteeringOutcome outcome;
  const std::vector<SteeredProcess> found = find(wanted, outcome);
  if (!outcome.error.empty()) {
    return outcome;
  }
  if ((request == Request::kStart || request == Request::kRestart) && is_ending()) {
    outcome.error = fmt::format("the launch is ending, nothing can {} any more", name_of(request));
    return outcome;
  }
  std::vector<std::string> names;
  for (const SteeredProcess& process : found) {
    names.push_back(process.name);
  }
  callbacks_.tell(fmt::format("launch {}: {}", name_of(request), fmt::join(names, ", ")));
  for (const SteeredProcess& process : found) {
    if (request == Request::kStop && process.waits && processes_.drop(*process.tracked)) {
      outcome.dropped.push_back(process.name);
    } else if (const std::string reason = carry_out(request, process, signal); reason.empty()) {
      outcome.done.push_back(process.name);
    } else {
      outcome.refused.push_back(process.name + " " + reason);
    }
  }
  callbacks_.done();
  return outcome;
}

std::string Steering::carry_out(Request request, const SteeredProcess& process, int signal) {
  if (process.id == 0) {
    return process.waits ? "waits for its start" : "has never been started";
  }
  const ProcessView view = supervisor_.view(process.id);
  const bool is_over = view.state == ProcessState::kDone;
  if (!is_over && process.away) {
    return fmt::format("runs on machine '{}', which is away", view.spec.machine);
  }
  switch (request) {
    case Request::kStop:
      if (is_over) {
        return "does not run";
      }
      if (!is_ending()) {
        stopped_.insert(process.id);
      }
      supervisor_.stop(process.id);
      return "";
    case Request::kStart:
      if (view.state == ProcessState::kRunning || view.state == ProcessState::kStarting) {
        return "runs already";
      }
      supervisor_.restart(process.id);
      return "";
    case Request::kRestart:
      supervisor_.restart(process.id);
      return "";
    case Request::kSignal:
      if (view.pid < 0) {
        return "does not run";
      }
      supervisor_.signal(process.id, signal);
      return "";
  }
  return "";
}

void Steering::shutdown() {
  callbacks_.shutdown("launch shutdown");
}

void Steering::on_event(const ProcessEvent& event) {
  if (std::holds_alternative<ProcessStarted>(event.what)) {
    stopped_.erase(event.id);
  }
}

}  // namespace launch
