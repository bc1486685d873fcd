// SPDX-License-Identifier: Apache-2.0
// What a launch file asks to do to running processes: `stop`, `restart`, `signal`, `set_priority`,
// `restore_priority`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/process/resource_limits.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

struct ProcessCommand {
  enum class Kind { kStop, kRestart, kSignal, kSetPriority, kRestorePriority };

  Kind kind = Kind::kStop;
  std::string process;        // one of its names (process_table.hpp)
  int signal = 0;             // of kSignal
  ResourceLimits scheduling;  // of kSetPriority: the niceness, the policy with its priority, and the CPUs that it says
  bool of_action = false;  // it means what an action of a Python file has started, and nothing if that was not visited
  SourceRange where;
};

// "stop", "restart", "signal", "set_priority", "restore_priority".
std::string_view name_of(ProcessCommand::Kind kind);

// "stop 'talker'", "signal SIGUSR1 to 'talker'", "set_priority of 'talker': nice 5".
std::string describe(const ProcessCommand& command);

// Throws LaunchError with every name that no process has, except the names of actions.
void check_commands(const std::vector<ProcessCommand>& commands, const ProcessTable& table);

}  // namespace launch
