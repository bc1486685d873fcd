// SPDX-License-Identifier: Apache-2.0
#include "launcher/invocation/argument_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "launcher/language/argument_use.hpp"

namespace launch {

bool is_read_in(const LaunchDescription& description, const std::string& name) {
  return description.file != nullptr && may_read(*description.file, name);
}

std::vector<Diagnostic> check_arguments(const std::vector<std::pair<std::string, std::string>>& arguments,
                                        const LaunchDescription& description, const ArgumentList& declared,
                                        Severity severity) {
  std::vector<std::string> known = own_configurations();
  for (const ArgumentInfo& argument : declared.arguments) {
    known.push_back(argument.declaration->name);
  }
  const auto is_known = [&](const std::string& name) {
    return std::find(known.begin(), known.end(), name) != known.end() || is_read_in(description, name) ||
           std::any_of(declared.loaded.begin(), declared.loaded.end(),
                       [&](const auto& included) { return is_read_in(*included, name); });
  };
  std::vector<Diagnostic> found;
  std::set<std::string> seen;
  for (const auto& [name, value] : arguments) {
    if (!seen.insert(name).second) {
      found.push_back({severity,
                       fmt::format("launch argument '{}' is given more than once", name),
                       {},
                       "the last one counts",
                       Finding::kUnknownArgument});
    } else if (declared.complete && !is_known(name)) {
      std::string help = did_you_mean(name, known);
      found.push_back({severity,
                       fmt::format("launch argument '{}' is unknown to the launch file", name),
                       {},
                       help.empty() ? "launch --show-args lists the arguments" : std::move(help),
                       Finding::kUnknownArgument});
    }
  }
  return found;
}

}  // namespace launch
