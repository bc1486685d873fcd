// SPDX-License-Identifier: Apache-2.0
// What is wrong with the command line of one process.
#pragma once

#include <functional>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/process/process_spec.hpp"

namespace launch {

// A missing program, missing parameter files in the arguments, and remaps without effect. Of a process that a condition
// leaves out only the program is searched for, with a warning.
void find_faults_of_process(const ProcessSpec& spec, bool left_out, const std::function<void(Diagnostic)>& report);

}  // namespace launch
