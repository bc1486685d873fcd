// SPDX-License-Identifier: Apache-2.0
// `launch FILE`: loads a launch file, and runs it or prints its plan or arguments.
#pragma once

#include "launcher/cli/command_line.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// Returns the exit code: 0, or 1 after an error of the launch itself. Errors go to standard error.
int run_command(const CommandLine& command, Environment environment);

}  // namespace launch
