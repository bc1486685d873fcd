// SPDX-License-Identifier: Apache-2.0
// What is wrong with the CPUs of a process on this machine.
#pragma once

#include <vector>

#include "launcher/visit/launch_context.hpp"

namespace launch {

// Remarks CPUs that the machine lacks. Warns of those that the launcher may not use: the kernel leaves them out without
// a word, as long as there are others.
void find_faults_of_cpus(const std::vector<int>& cpus, const SourceRange& where, LaunchContext& context);

}  // namespace launch
