// SPDX-License-Identifier: Apache-2.0
// What can be said about a launch file without visiting it: its arguments, with those of the files that it includes.
#pragma once

#include <string>
#include <vector>

#include "launcher/language/launch_description.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

struct ArgumentInfo {
  const ArgumentDeclaration* declaration;
  // It or an action around it has a condition, or waits for something: it may never be needed.
  bool conditional = false;
};

// The declarations of a description and of every included file whose path can be performed in `scope` (literal, or by
// packages, environment and, when scope.current_file is set, $(dirname)); other includes are passed over. The first
// declaration of a name wins. Included descriptions are kept in `loaded`, for the declarations point into them.
struct ArgumentList {
  std::vector<ArgumentInfo> arguments;
  std::vector<std::shared_ptr<const LaunchDescription>> loaded;
  bool complete = true;  // no include was passed over
};
ArgumentList find_arguments(const LaunchDescription& description, const Registry& registry, Scope scope);

// Throws LaunchError at `where` when an unconditional argument without default is not in `given`, nor given by the
// include that leads to it. Descends like find_arguments() without $(dirname), as ros2 launch does.
void check_required_arguments(const LaunchDescription& description, const Registry& registry, Scope scope,
                              const std::vector<std::string>& given, const SourceRange& where);

// The text of --show-args: `ros2 launch`'s.
std::string show_arguments(const ArgumentList& list);

}  // namespace launch
