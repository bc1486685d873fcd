// SPDX-License-Identifier: Apache-2.0
// `launch FILE`: loads a launch file, and runs it or prints its plan or arguments.
#pragma once

#include <memory>

#include "launcher/language/launch_description.hpp"
#include "launcher/substitution/scope.hpp"
#include "programs/launch/run/command_line.hpp"

namespace launch {

// Runs the launch files that the command line names, or `description`. Returns the exit code: that of the launch
// (LaunchService::run), else 0, or 1 after an error. Errors go to standard error.
int run_command(const CommandLine& command, Environment environment,
                std::shared_ptr<const LaunchDescription> description = nullptr);

}  // namespace launch
