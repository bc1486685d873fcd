// SPDX-License-Identifier: Apache-2.0
// `launch FILE`: loads a launch file, and runs it or prints its plan or arguments.
#pragma once

#include <memory>

#include "launcher/language/launch_description.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"
#include "programs/launch/run/command_line.hpp"

namespace launch {

// Runs the launch files that the command line names, or `description`. Returns the exit code: that of the launch
// (LaunchService::run), else 0, or 1 after an error. Errors go to standard error.
int run_command(const CommandLine& command, Environment environment,
                std::shared_ptr<const LaunchDescription> description = nullptr);

// `launch --trace`: records a launch whose file asks for no trace.
// Returns the description with a <trace> of the default attributes at its end, named after the file and the time. This
// <trace> counts only when the visit has met no other one before. It may stand at the end because traces begin before
// processes.
std::shared_ptr<const LaunchDescription> with_trace(const LaunchDescription& description, const Registry& registry);

}  // namespace launch
