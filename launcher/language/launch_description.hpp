// SPDX-License-Identifier: Apache-2.0
// A loaded launch file: its actions, made and checked, nothing visited yet.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "launcher/language/action.hpp"
#include "launcher/language/registry.hpp"
#include "launcher/substitution/scope.hpp"

namespace launch {

struct LaunchDescription {
  std::shared_ptr<const SourceFile> file;  // null for several files together
  std::vector<ActionPtr> actions;
  std::string deprecated;  // the text of the root's `deprecated`, empty when there is none
  // What a Python file did to its environment while it was loaded; nothing: removed. Done when it is visited.
  std::map<std::string, std::optional<std::string>> environment_changes;
};

// Reads and parses a launch file, or has it loaded by the registry's loader for its ending. `scope` is where it will be
// visited: a Python file sees its environment and packages. `included_from` is the place of the include that asks for
// it. Throws LaunchError with every error of the file.
std::shared_ptr<const LaunchDescription> load_launch_description(const std::string& path, const Registry& registry,
                                                                 const Scope& scope, SourceRange included_from = {});

// The same for text that is already read.
std::shared_ptr<const LaunchDescription> parse_launch_description(std::shared_ptr<const SourceFile> file,
                                                                  const Registry& registry, const Scope& scope = {});

}  // namespace launch
