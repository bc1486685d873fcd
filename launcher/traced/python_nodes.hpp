// SPDX-License-Identifier: Apache-2.0
// <trace python-nodes="true">: events of the callbacks of rclpy, by a module that each Python program loads at its
// start.
#pragma once

#include <string>
#include <vector>

#include "launcher/process/process_spec.hpp"

namespace launch {

// Puts the module in front of PYTHONPATH, once. `prefix`: of this installation.
void give_python_nodes_events(const std::string& prefix, Environment& environment);

// A sentence on those of the processes that will not load the module, and why. "" if there are none.
std::string python_nodes_without_events(const std::vector<ProcessSpec>& processes, const std::string& prefix);

}  // namespace launch
