// SPDX-License-Identifier: Apache-2.0
// The messages about events of processes, with the texts of ROS 2 launch.
#pragma once

#include <string>

#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/process/process_supervisor.hpp"

namespace launch {

// An observer that writes a launcher message for each event of a process; the logger is the label of the process.
// Failures end with the place in the launch file that asked for the process. `output` must outlive the supervisor.
ProcessSupervisor::Observer process_messages(OutputRouter& output);

// How a process has ended, in words: "exit code 3", "SIGSEGV", "SIGSEGV, core dumped,",
// "SIGKILL by the kernel, for want of memory,".
std::string end_of(const ProcessExit& exit);

// "SIGSEGV, core dumped, after 12.41 s, with 3.10 s of processor time and 48.2 MiB"
std::string describe(const ProcessExit& exit);

}  // namespace launch
