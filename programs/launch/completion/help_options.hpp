// SPDX-License-Identifier: Apache-2.0
// The options of a command as its help prints them: the help is the only list of them, also for the programs that
// `launch` becomes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

struct HelpOption {
  std::vector<std::string> names;    // "-o", "--output"
  std::vector<std::string> choices;  // the values that it takes, if the help lists them
};

std::vector<HelpOption> options_in_help(std::string_view help);

// What a program prints; "" if it can't be run.
std::string output_of(const std::string& program, std::vector<std::string> argv);

// Runs `launch WORDS --help`. No options if it can't be run.
std::vector<HelpOption> options_of_command(std::vector<std::string> words);

}  // namespace launch
