// SPDX-License-Identifier: Apache-2.0
// A loaded launch file: its actions are made and checked, but nothing is visited yet.
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
  // The changes that a Python file made to its environment while it was loaded; nullopt: removed. They are applied at
  // the visit.
  std::map<std::string, std::optional<std::string>> environment_changes;
};

// Reads and parses a launch file, or lets the registry's loader for its ending load it. `scope` is the scope of the
// visit: a Python file sees its environment and packages. `included_from` is the place of the include that asks for the
// file. Throws LaunchError with every error of the file.
std::shared_ptr<const LaunchDescription> load_launch_description(const std::string& path, const Registry& registry,
                                                                 const Scope& scope, SourceRange included_from = {});

// The same for text that is already read.
std::shared_ptr<const LaunchDescription> parse_launch_description(std::shared_ptr<const SourceFile> file,
                                                                  const Registry& registry, const Scope& scope = {});

}  // namespace launch
