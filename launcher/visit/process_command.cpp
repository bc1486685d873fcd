// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/process_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string.h>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

std::string_view name_of(ProcessCommand::Kind kind) {
  switch (kind) {
    case ProcessCommand::Kind::kStop:
      return "stop";
    case ProcessCommand::Kind::kRestart:
      return "restart";
    case ProcessCommand::Kind::kSignal:
      return "signal";
    case ProcessCommand::Kind::kSetPriority:
      return "set_priority";
    case ProcessCommand::Kind::kRestorePriority:
      return "restore_priority";
  }
  return "";
}

std::string describe(const ProcessCommand& command) {
  switch (command.kind) {
    case ProcessCommand::Kind::kSignal:
      return fmt::format("signal SIG{} to '{}'", ::sigabbrev_np(command.signal), command.process);
    case ProcessCommand::Kind::kSetPriority:
      return fmt::format("set_priority of '{}': {}", command.process, fmt::join(describe(command.scheduling), ", "));
    default:
      return fmt::format("{} '{}'", name_of(command.kind), command.process);
  }
}

void check_commands(const std::vector<ProcessCommand>& commands, const ProcessTable& table) {
  std::vector<Diagnostic> errors;
  for (const ProcessCommand& command : commands) {
    if (!command.of_action && table.find(command.process).empty()) {
      errors.push_back({Severity::kError, fmt::format("no process is named '{}'", command.process), command.where,
                        did_you_mean(command.process, table.names()), Finding::kUnknownProcess});
    }
  }
  if (!errors.empty()) {
    throw LaunchError(std::move(errors));
  }
}

}  // namespace launch
