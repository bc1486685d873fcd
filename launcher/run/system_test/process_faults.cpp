// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/process_faults.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <optional>
#include <utility>
#include <variant>

namespace launch {
namespace {

// A slow process runs and stands still once in this time.
constexpr Duration kTurn = std::chrono::milliseconds(100);
constexpr unsigned kWhole = 100;  // percent

std::string command_of(const ClockFault& clock) {
  switch (clock.kind) {
    case ClockFault::Kind::kStop:
      return "stop\n";
    case ClockFault::Kind::kSkew:
      return fmt::format("scale {}\n", clock.rate);
    case ClockFault::Kind::kJump:
      return fmt::format("jump {}\n", clock.by);
  }
  return {};
}

// Takes back what command_of() has told the clock. "": nothing to take back.
std::string opposite_of(const ClockFault& clock) {
  switch (clock.kind) {
    case ClockFault::Kind::kStop:
      return "go\n";
    case ClockFault::Kind::kSkew:
      return fmt::format("scale {}\n", 1 / clock.rate);
    case ClockFault::Kind::kJump:
      return {};
  }
  return {};
}

}  // namespace

std::string ProcessFaults::apply(const FaultRequest& fault, const std::vector<ProcessId>& processes) {
  Applied& applied = applied_[fault.number];
  for (const ProcessId process : processes) {
    std::string reason = apply_to(process, fault, applied);
    if (!reason.empty()) {
      return reason;
    }
    applied.processes.push_back(process);
  }
  if (const auto* const slow = std::get_if<SlowFault>(&fault.what)) {
    turn(fault.number, slow->percent, false);
  }
  return {};
}

std::string ProcessFaults::apply_to(ProcessId process, const FaultRequest& fault, Applied& applied) {
  if (const auto* const kill = std::get_if<KillFault>(&fault.what)) {
    supervisor_.signal(process, kill->signal);
  } else if (std::holds_alternative<StopFault>(fault.what)) {
    hold(fault.number, process);
  } else if (const auto* const limits = std::get_if<LimitFault>(&fault.what)) {
    if (!limit(process, *limits, applied)) {
      return fmt::format("'{}' can't be limited", fault.process);
    }
  } else if (const auto* const clock = std::get_if<ClockFault>(&fault.what)) {
    if (!is_clock(supervisor_.view(process).spec)) {
      return fmt::format("'{}' is no clock", fault.process);
    }
    if (!supervisor_.write(process, command_of(*clock))) {
      return fmt::format("'{}' does not obey", fault.process);
    }
  }
  return {};
}

bool ProcessFaults::limit(ProcessId process, const LimitFault& limits, Applied& applied) {
  const std::pair<int, std::optional<std::uint64_t>> resources[] = {{RLIMIT_AS, limits.memory},
                                                                    {RLIMIT_NOFILE, limits.files}};
  for (const auto& [resource, value] : resources) {
    if (!value) {
      continue;
    }
    const std::optional<std::uint64_t> before = supervisor_.limit(process, resource, *value);
    if (!before) {
      return false;
    }
    applied.limits.push_back({process, resource, *before});
  }
  return true;
}

// Lets the processes of a slow fault run, or stand still, for their part of a turn.
void ProcessFaults::turn(std::size_t number, unsigned percent, bool runs) {
  Applied& applied = applied_.at(number);
  for (const ProcessId process : applied.processes) {
    if (runs) {
      release(number, process);
    } else {
      hold(number, process);
    }
  }
  applied.turn = loop_.after(kTurn * (runs ? percent : kWhole - percent) / kWhole,
                             [this, number, percent, runs] { turn(number, percent, !runs); });
}

void ProcessFaults::hold(std::size_t number, ProcessId process) {
  if (supervisor_.view(process).pid < 0) {
    return;
  }
  std::set<std::size_t>& holders = held_[process];
  if (holders.empty()) {
    supervisor_.pause(process);
  }
  holders.insert(number);
}

void ProcessFaults::release(std::size_t number, ProcessId process) {
  const auto held = held_.find(process);
  if (held != held_.end() && held->second.erase(number) > 0 && held->second.empty()) {
    held_.erase(held);
    supervisor_.resume(process);
  }
}

void ProcessFaults::end(const FaultRequest& fault) {
  const auto found = applied_.find(fault.number);
  if (found == applied_.end()) {
    return;
  }
  const Applied applied = std::move(found->second);
  applied_.erase(found);
  for (const ProcessId process : applied.processes) {
    release(fault.number, process);
  }
  for (const Limit& limit : applied.limits) {
    supervisor_.limit(limit.process, limit.resource, limit.before);
  }
  const auto* const clock = std::get_if<ClockFault>(&fault.what);
  const std::string command = clock == nullptr ? "" : opposite_of(*clock);
  if (!command.empty()) {
    for (const ProcessId process : applied.processes) {
      supervisor_.write(process, command);
    }
  }
}

void ProcessFaults::on_exit(ProcessId process) {
  held_.erase(process);
  for (auto& [number, applied] : applied_) {
    std::erase_if(applied.limits, [&](const Limit& limit) { return limit.process == process; });
  }
}

void ProcessFaults::shutdown() {
  applied_.clear();
  for (const auto& [process, holders] : held_) {
    supervisor_.resume(process);
  }
  held_.clear();
}

}  // namespace launch
