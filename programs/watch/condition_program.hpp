// SPDX-License-Identifier: Apache-2.0
// launch-watch --conditions: decides the conditions of a launch file on what its nodes do.
#pragma once

#include <set>
#include <string>

namespace launch {

// Records the nodes in a live session of its own until standard input ends. The lines that it reads and writes are
// those of tracing/model/conditions/condition_lines.hpp. `launch`: the number of the launch, whose processes alone
// count. `needs`: what all conditions need (needs_of in live_condition.hpp). Returns the exit code.
int run_condition_program(const std::string& launch, std::set<std::string> needs);

}  // namespace launch
