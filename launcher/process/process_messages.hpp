// SPDX-License-Identifier: Apache-2.0
// The messages about events of processes, with the texts of ROS 2 launch.
#pragma once

#include "launcher/process/output/output_router.hpp"
#include "launcher/process/process_supervisor.hpp"

namespace launch {

// An observer that writes a launcher message for each event of a process; the logger is the label of the process.
// Failures end with the place in the launch file that asked for the process. `output` must outlive the supervisor.
ProcessSupervisor::Observer process_messages(OutputRouter& output);

}  // namespace launch
