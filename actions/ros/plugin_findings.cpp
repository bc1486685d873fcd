// SPDX-License-Identifier: Apache-2.0
#include "actions/ros/plugin_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

namespace fs = std::filesystem;

// The resource of the ament index that a container reads: a line PLUGIN;LIBRARY for each plugin.
fs::path registrations_of(const std::string& prefix, const std::string& package) {
  return fs::path(prefix) / "share/ament_index/resource_index/rclcpp_components" / package;
}

}  // namespace

void find_missing_plugin(const ComposableNode& node, const Environment& environment, const SourceRange& package_where,
                         const SourceRange& plugin_where, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  PackageIndex& packages = *context.scope().packages;
  std::string prefix;
  try {
    prefix = packages.prefix(node.package, environment);
  } catch (const std::runtime_error& error) {
    context.exploration().remark({Severity::kError, error.what(), package_where,
                                  packages.help_for_missing(node.package, environment), Finding::kMissingPackage});
    return;
  }
  std::ifstream file(registrations_of(prefix, node.package));
  if (!file) {
    context.exploration().remark(
        {Severity::kError, fmt::format("package '{}' registers no components", node.package), package_where,
         fmt::format("'{}' does not exist", registrations_of(prefix, node.package).string()), Finding::kMissingPlugin});
    return;
  }
  std::vector<std::string> plugins;
  for (std::string line; std::getline(file, line);) {
    const std::size_t end = line.find(';');
    plugins.push_back(line.substr(0, end));
    if (plugins.back() != node.plugin) {
      continue;
    }
    const fs::path library = end == std::string::npos ? fs::path() : fs::path(prefix) / line.substr(end + 1);
    std::error_code ignored;
    if (!library.empty() && !fs::exists(library, ignored)) {
      context.exploration().remark(
          {Severity::kError, fmt::format("the library of plugin '{}' does not exist", node.plugin), plugin_where,
           fmt::format("package '{}' names '{}'", node.package, library.string()), Finding::kMissingPlugin});
    }
    return;
  }
  std::string help = did_you_mean(node.plugin, plugins);
  if (help.empty() && !plugins.empty()) {
    help = fmt::format("it has {}{}", plugins.front(), plugins.size() > 1 ? " and others" : "");
  }
  context.exploration().remark(
      {Severity::kError, fmt::format("no library of package '{}' registers the plugin '{}'", node.package, node.plugin),
       plugin_where, std::move(help), Finding::kMissingPlugin});
}

}  // namespace launch
