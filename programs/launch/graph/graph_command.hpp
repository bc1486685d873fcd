// SPDX-License-Identifier: Apache-2.0
// `launch graph`: draws what a launch file would run.
#pragma once

#include <string>
#include <vector>

#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// Takes the words after the name of the command. Returns the exit code: 0, 1 after an error in a launch file, 2 after a
// wrong command line.
int graph_command(const std::vector<std::string>& words, const Registry& registry, const Environment& environment);

}  // namespace launch
