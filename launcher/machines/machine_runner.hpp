// SPDX-License-Identifier: Apache-2.0
// The ProcessRunner of a launch with several machines: a process of another machine is started there by its agent, all
// others here.
#pragma once

#include <memory>

#include "launcher/machines/machine_connections.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {

// Both must outlive the runner.
std::unique_ptr<ProcessRunner> make_machine_runner(ProcessRunner& here, MachineConnections& machines);

}  // namespace launch
