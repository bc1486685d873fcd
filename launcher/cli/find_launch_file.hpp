// SPDX-License-Identifier: Apache-2.0
// From the words of the command line to launch files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "launcher/language/launch_description.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// Paths of files, "-" for standard input; or a package, which is no file, and the base name of exactly one file
// anywhere below its share directory. Throws LaunchError without a place.
std::vector<std::string> find_launch_files(const std::vector<std::string>& words, const Scope& scope);

// Loads what find_launch_files() has found: several files are one description, which visits them in turn. Throws
// LaunchError.
std::shared_ptr<const LaunchDescription> load_launch_files(const std::vector<std::string>& paths,
                                                           const Registry& registry, const Scope& scope);

}  // namespace launch
