// SPDX-License-Identifier: Apache-2.0
// What a launch tells of itself: to those who ask it, and in its first lines.
#pragma once

#include <string>
#include <vector>

#include "launcher/control/launch_control.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/isolation/namespaces.hpp"
#include "launcher/process/output/output_router.hpp"
#include "programs/launch/run/command_line.hpp"

namespace launch {

LaunchFacts launch_facts(const CommandLine& command, const std::vector<std::string>& files, const Guardian& guardian,
                         const Isolation& isolation, const std::string& log_directory, const std::string& log);

// Where it stands apart from other launches, if it does.
void tell_isolation(const CommandLine& command, const Isolation& isolation, OutputRouter& output);

}  // namespace launch
