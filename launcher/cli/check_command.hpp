// `launch check`, `launch graph` and `launch schema`: what can be said of launch files without running them.
#pragma once

#include <string>
#include <vector>

#include "launcher/core/registry.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// Each takes the words after its name and returns the exit code: 0, 1 after an error in a launch file, 2 after a wrong
// command line.
int check_command(const std::vector<std::string>& words, const Registry& registry, const Environment& environment);
int graph_command(const std::vector<std::string>& words, const Registry& registry, const Environment& environment);
int schema_command(const std::vector<std::string>& words, const Registry& registry);

}  // namespace launch
