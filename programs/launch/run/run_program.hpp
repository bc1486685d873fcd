// SPDX-License-Identifier: Apache-2.0
// `launch run PACKAGE PROGRAM [ARGUMENT …]`: runs a program of a package on this terminal, as `ros2 run` does, and ends
// what it has started when it ends.
#pragma once

#include <string>
#include <vector>

#include "base/environment/environment.hpp"

namespace launch {

// `words` are the words after `run`. Returns the exit code of the program, 128+N if signal N ended it, 1 if it could
// not be started, 2 for a wrong command line.
int run_program_command(const std::vector<std::string>& words, const Environment& environment);

// The options, packages or programs that the shells' completion offers for the last word.
std::vector<std::string> run_program_completions(const std::vector<std::string>& words, const Environment& environment);

}  // namespace launch
