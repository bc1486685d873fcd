// SPDX-License-Identifier: Apache-2.0
// Runs a command to its end and keeps what it writes.
#pragma once

#include <string>
#include <vector>

#include "launcher/substitution/scope.hpp"

namespace launch {

struct CommandOutput {
  std::string text;   // standard output, and standard error if that was asked for
  std::string error;  // standard error otherwise
  int status = 0;     // as waitpid() gives it
};

// Blocks until the program has ended. `program` is a path; its standard input is empty. Throws std::runtime_error when
// it can't be started.
CommandOutput capture_command(const std::string& program, const std::vector<std::string>& argv,
                              const Environment& environment, bool merge_error);

// "exit code 2", "killed by signal 9".
std::string describe_status(int status);

}  // namespace launch
