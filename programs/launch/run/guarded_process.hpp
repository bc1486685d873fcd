// SPDX-License-Identifier: Apache-2.0
// Puts this process below a guardian, before it runs a launch.
#pragma once

#include "launcher/process/guardian/containment.hpp"
#include "launcher/process/guardian/guardian.hpp"
#include "launcher/process/isolation/namespaces.hpp"
#include "programs/launch/run/command_line.hpp"

namespace launch {

// For `--contain`. Throws std::runtime_error.
Containment contain(const CommandLine& command);

// Before anything else: a launch file can start processes while it is loaded. Programs that the launcher starts for
// itself have the mark of the launch, too. Throws std::runtime_error.
Guardian guard_this_process(const CommandLine& command, const Isolation& isolation, Containment containment);

// The guardian learns where Python of launch files is.
void watch_python(const CommandLine& command, const Guardian& guardian);

}  // namespace launch
