// `launch complete`: what the shells' completion (launcher/cli/completion/) offers for the last word of a command line.
#pragma once

#include <string>
#include <vector>

#include "launcher/core/registry.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// `words` are those after `launch`, the last one perhaps empty or begun. Names of files are left to the shell.
std::vector<std::string> completions(const std::vector<std::string>& words, const Registry& registry,
                                     const Environment& environment);

}  // namespace launch
