// What `launch --dry-run` prints.
#pragma once

#include <string>

#include "launcher/core/launch_plan.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// For people: each trace and each process with its command line, as a shell would read it.
std::string plan_as_text(const LaunchPlan& plan, const Environment& launcher_environment);

// For programs: an object with `processes` (name, argv, cwd, env, shell, source), `params` (the contents of generated
// parameter files; "@params:N" stands for their paths in argv) and `traces` (their evaluated attributes).
// `env` holds only what differs from the launcher's own environment, null for a removed variable.
std::string plan_as_json(const LaunchPlan& plan, const Environment& launcher_environment);

}  // namespace launch
