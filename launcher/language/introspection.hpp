// SPDX-License-Identifier: Apache-2.0
// The facts about a launch file that are known without a visit: its arguments, and those of the files that it includes.
#pragma once

#include <string>
#include <vector>

#include "launcher/language/launch_description.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

struct ArgumentInfo {
  const ArgumentDeclaration* declaration;
  // The argument, or an action around it, has a condition or waits for something: the argument may never be needed.
  bool conditional = false;
};

// The declarations of a description and of every included file whose path can be performed in `scope` (literal, or with
// packages, environment and, when scope.current_file is set, $(dirname)). Other includes are skipped. The first
// declaration of a name wins. Included descriptions are kept in `loaded`, because the declarations point into them.
struct ArgumentList {
  std::vector<ArgumentInfo> arguments;
  std::vector<std::shared_ptr<const LaunchDescription>> loaded;
  bool complete = true;  // no include was skipped
};
ArgumentList find_arguments(const LaunchDescription& description, const Registry& registry, Scope scope);

// Throws LaunchError at `where` when an unconditional argument without default is neither in `given` nor given by the
// include that leads to it. Follows includes like find_arguments() without $(dirname), as ros2 launch does.
void check_required_arguments(const LaunchDescription& description, const Registry& registry, Scope scope,
                              const std::vector<std::string>& given, const SourceRange& where);

// The text of --show-args, as `ros2 launch` prints it.
std::string show_arguments(const ArgumentList& list);

}  // namespace launch
