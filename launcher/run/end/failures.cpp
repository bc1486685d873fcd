// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/end/failures.hpp"

#include <fmt/format.h>

#include <utility>

#include "launcher/process/process_messages.hpp"

namespace launch {
namespace {

std::string place(const SourceRange& where) {
  return where ? fmt::format(" ({})", to_string(where)) : std::string();
}

}  // namespace

void Failures::on_process_event(const ProcessEvent& event) {
  if (const auto* const exited = std::get_if<ProcessExited>(&event.what)) {
    if (has_failed(event.spec, *exited)) {
      add(event, describe(exited->exit));
    }
  } else if (const auto* const failed = std::get_if<ProcessStartFailed>(&event.what)) {
    add(event, "not started, " + failed->reason);
  } else if (const auto* const health = std::get_if<HealthChanged>(&event.what)) {
    if (health->health == Health::kUnhealthy) {
      add(event, "unhealthy, " + health->reason);
    }
  }
}

void Failures::add(const std::string& what, const SourceRange& where) {
  others_.push_back(what + place(where));
}

void Failures::add(const ProcessEvent& event, std::string failure) {
  Process& process = processes_[event.id];
  process.label = event.label;
  process.where = event.spec.origin;
  process.last_failure = std::move(failure);
  ++process.count;
}

std::vector<std::string> Failures::summary() const {
  std::vector<std::string> lines;
  if (!processes_.empty()) {
    lines.push_back(processes_.size() == 1 ? "1 process has failed:"
                                           : fmt::format("{} processes have failed:", processes_.size()));
  }
  for (const auto& [id, process] : processes_) {
    const std::string times = process.count == 1 ? "" : fmt::format("; the last of {} failures", process.count);
    lines.push_back(fmt::format("  {}: {}{}{}", process.label, process.last_failure, times, place(process.where)));
  }
  lines.insert(lines.end(), others_.begin(), others_.end());
  return lines;
}

}  // namespace launch
