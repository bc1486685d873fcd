// SPDX-License-Identifier: Apache-2.0
// The output of `launch --dry-run=shell`, and the difference between environments.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/text/shell_quoted.hpp"
#include "launcher/substitution/scope.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace launch {

// A script that starts the processes in order and all at once, and waits for them. It starts no traces and supervises
// nothing. Comments in it name what it leaves out.
std::string plan_as_shell_script(const LaunchPlan& plan, const Environment& launcher_environment);

// The changes that turn `to` into `of`; nullopt: the variable is removed.
std::map<std::string, std::optional<std::string>> environment_difference(const Environment& of, const Environment& to);

}  // namespace launch
