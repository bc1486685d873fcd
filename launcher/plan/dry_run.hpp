// SPDX-License-Identifier: Apache-2.0
// What `launch` prints in place of running: --dry-run, --dry-run=json, --dry-run=shell, --print.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "launcher/language/launch_description.hpp"
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

// Of this JSON. It becomes another number when a key changes its meaning or goes.
constexpr int kDryRunVersion = 1;

// The schema of this JSON: docs/schema/dry_run.schema.json, which the build puts into the launcher.
std::string_view dry_run_schema();

// A script that starts the processes in order and all at once, and waits for them. It starts no traces and supervises
// nothing. Comments in it name what it leaves out.
std::string plan_as_shell_script(const LaunchPlan& plan, const Environment& launcher_environment);

// The changes that turn `to` into `of`; nullopt: the variable is removed.
std::map<std::string, std::optional<std::string>> environment_difference(const Environment& of, const Environment& to);

// Those of the process. Of a process on another machine, whose environment is not known, what the launch file sets.
std::map<std::string, std::optional<std::string>> shown_changes(const ProcessSpec& spec,
                                                                const Environment& launcher_environment);

// The actions as the launch file has them: a tree with a line per element. Includes are followed when their path can be
// known without visiting.
std::string print_description(const LaunchDescription& description, const Registry& registry, const Scope& scope);

}  // namespace launch
