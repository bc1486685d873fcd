// From the words of the command line to the path of a launch file.
#pragma once

#include <string>
#include <vector>

#include "launcher/substitution/scope.hpp"

namespace launch {

// One word: a path. Two words, the first of which is no file: a package, and the base name of exactly one file anywhere
// below its share directory. Throws LaunchError without a place.
std::string find_launch_file(const std::vector<std::string>& words, const Scope& scope);

}  // namespace launch
