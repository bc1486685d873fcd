// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/argument_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace launch {

namespace {

constexpr std::string_view kOwnConfigurations[] = {"launch-prefix",   "launch-prefix-filter", "sigterm_timeout",
                                                   "sigkill_timeout", "emulate_tty",          "ros_namespace"};

}  // namespace

bool is_read_in(const LaunchDescription& description, const std::string& name) {
  if (description.file == nullptr) {
    return false;
  }
  const std::string& text = description.file->text();
  if (description.file->path().ends_with(".py")) {
    return text.find(fmt::format("'{}'", name)) != std::string::npos ||
           text.find(fmt::format("\"{}\"", name)) != std::string::npos;
  }
  return text.find(fmt::format("$(var {})", name)) != std::string::npos ||
         text.find(fmt::format("$(var {} ", name)) != std::string::npos;
}

std::vector<Diagnostic> check_arguments(const std::vector<std::pair<std::string, std::string>>& arguments,
                                        const LaunchDescription& description, const ArgumentList& declared,
                                        Severity severity) {
  std::vector<std::string> known(std::begin(kOwnConfigurations), std::end(kOwnConfigurations));
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
