// SPDX-License-Identifier: Apache-2.0
// A function for each command that asks a running launch. They throw ControlError.
#pragma once

#include <string>
#include <vector>

#include "base/environment/environment.hpp"

namespace launch {

// Of the option --launch.
inline constexpr const char* kLaunchHelp = "number or file of the launch, if several run";

int ps_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment);
// stop, start, restart
int steer_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment);
int signal_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment);
int shutdown_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment);
int events_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment);
int top_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment);
int logs_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment);

}  // namespace launch
