// SPDX-License-Identifier: Apache-2.0
// What a recorded run tells of a plan: remaps of names that the nodes do not have.
#pragma once

#include <functional>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "programs/launch/check/recorded_nodes.hpp"

namespace launch {

// A node of the plan is the recorded one of its name. Where the program gives the name, it is any node of a process of
// this program. A remap has an effect if the node has the name before or behind it, because the run that was recorded
// may have had the remap or not. Nothing is said of nodes that were not recorded. A rule for several nodes is told
// once, if none of them has the names.
void find_remaps_of_unknown_names(const LaunchPlan& plan, const std::vector<RecordedNode>& recorded,
                                  const std::function<void(Diagnostic)>& report);

}  // namespace launch
