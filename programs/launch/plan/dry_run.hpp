// SPDX-License-Identifier: Apache-2.0
// The output of `launch --dry-run`.
#pragma once

#include <string>

#include "launcher/substitution/scope.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace launch {

// For people: each trace and each process with its command line, as a shell would read it.
std::string plan_as_text(const LaunchPlan& plan, const Environment& launcher_environment);

// For programs: an object with
//   processes        name, argv, cwd, env, shell, source; for ROS nodes also `node`. `params` are the contents of
//                    generated parameter files, for whose paths "@params:N" stands in argv. `env` holds only what
//                    differs from the launcher's own environment, null for a removed variable
//   composable       load requests: target and nodes, each with typed parameters [name, type, value]
//   traces           their evaluated attributes
//   logs             messages of `log` actions
//   python_includes  Python launch files, which count as empty
//   only_in_a_run    what depends on functions that timers and handlers would call: function, why, source
//   includes, shutdown  how many other files were included; whether a `shutdown` was visited
std::string plan_as_json(const LaunchPlan& plan, const Environment& launcher_environment);

}  // namespace launch
