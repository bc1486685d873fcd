// SPDX-License-Identifier: Apache-2.0
// What is wrong with a plan as a whole: programs, remaps, and names that must fit together.
#pragma once

#include <functional>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace launch {

// `left_out` are the requests of actions that their conditions leave out. Their processes are searched for, too, with
// warnings, and their names count as known.
void find_faults_of_plan(const LaunchPlan& plan, const std::vector<Requests>& left_out,
                         const std::function<void(Diagnostic)>& report);

}  // namespace launch
