// SPDX-License-Identifier: Apache-2.0
// What the command line and the environment say of screen and logs.
#pragma once

#include <string>

#include "base/environment/environment.hpp"
#include "launcher/process/output/old_logs.hpp"
#include "launcher/process/output/output_router.hpp"
#include "programs/launch/run/command_line.hpp"

namespace launch {

// Both throw std::invalid_argument with a sentence. The loop must outlive the router with these options.
OutputRouter::Options output_options(const CommandLine& command, const Environment& environment,
                                     const std::string& log_directory, EventLoop& loop);
// By the option, or else by the variable.
LogLimits log_limits(const CommandLine& command, const Environment& environment);

}  // namespace launch
