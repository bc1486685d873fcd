// SPDX-License-Identifier: Apache-2.0
// Finds the launch files that the words of the command line mean.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "launcher/language/launch_description.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

// Whether the name is that of a launch file: robot.launch.xml, robot_launch.py.
bool is_launch_file(const std::filesystem::path& path);

// The words are paths of files, with "-" for standard input. Or they are a package (a word that is no file) and the
// base name of exactly one file anywhere below its share directory. Throws LaunchError without a place; it suggests one
// of `commands`, names of commands of `launch`, for a word that looks like a mistyped one.
std::vector<std::string> find_launch_files(const std::vector<std::string>& words, const Scope& scope,
                                           const std::vector<std::string>& commands = {});

// Loads the files that find_launch_files() has found. Several files become one description, which visits them in turn.
// Throws LaunchError.
std::shared_ptr<const LaunchDescription> load_launch_files(const std::vector<std::string>& paths,
                                                           const Registry& registry, const Scope& scope);

}  // namespace launch
