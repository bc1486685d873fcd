// SPDX-License-Identifier: Apache-2.0
// The parameters that the nodes of a run had. A launch file does not tell them: a program declares its parameters
// itself. A trace does not tell them either; `launch param dump NODE` does.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace launch {

// The names of the parameters of each node, by its full name.
using RecordedParameters = std::map<std::string, std::set<std::string>>;

// Adds those of a file that `launch param dump` or `ros2 param dump` has written, of one node or of several. Throws
// LaunchError.
void read_recorded_parameters(const std::string& path, RecordedParameters& parameters);

// A warning for each parameter that the plan gives to a node which did not have it. Nothing is said of nodes that were
// not dumped, nor of nodes whose program chooses the name. Of a file of parameters only sections for this one node
// count.
void find_unknown_parameters(const LaunchPlan& plan, const RecordedParameters& recorded,
                             const std::function<void(Diagnostic)>& report);

}  // namespace launch
