// SPDX-License-Identifier: Apache-2.0
// What a launch file asks to do to running processes: `stop`, `restart`, `signal`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/source.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

struct ProcessCommand {
  enum class Kind { kStop, kRestart, kSignal };

  Kind kind = Kind::kStop;
  std::string process;  // one of its names (process_table.hpp)
  int signal = 0;       // of kSignal
  SourceRange where;
};

// "stop", "restart", "signal".
std::string_view name_of(ProcessCommand::Kind kind);

// Throws LaunchError with every name that no process has.
void check_commands(const std::vector<ProcessCommand>& commands, const ProcessTable& table);

}  // namespace launch
