// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/check_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "launcher/base/own_prefix.hpp"
#include "launcher/cli/check_launch_file.hpp"
#include "launcher/cli/diagnostic_output.hpp"
#include "launcher/cli/find_launch_file.hpp"
#include "launcher/cli/result_output.hpp"
#include "launcher/cli/subcommand.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

// The scope that find_launch_files() needs to look for packages.
Scope scope_of(const Environment& environment) {
  Scope scope;
  scope.environment = environment;
  scope.packages = std::make_shared<PackageIndex>(own_prefix());
  return scope;
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

int check_command(const std::vector<std::string>& words, const Registry& registry, const Environment& environment) {
  std::string format = "text";
  CheckOptions options;
  LaunchTarget target;
  Subcommand command(
      "launch check",
      "Finds the errors of launch files without running anything: visits them, including actions that conditions leave "
      "out, and "
      "looks for the packages, programs, parameter files and included files that they name. Exit code 1 when there are "
      "errors.");
  command.take_target(target);
  command.take_choice("--format", format, {"text", "json", "sarif"}, "text, json or sarif");
  command.take_flag("--strict-ros2", options.strict_ros2,
                    "tags and attributes that ros2 launch does not know are errors");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  ResultOutput result;
  options.arguments = target.arguments;
  std::vector<Diagnostic> found;
  std::size_t files = 0;
  try {
    for (const std::string& path : find_launch_files(target.words, scope_of(environment))) {
      ++files;
      const std::vector<Diagnostic> of_file = check_launch_file(path, registry, environment, options);
      found.insert(found.end(), of_file.begin(), of_file.end());
    }
  } catch (const LaunchError& error) {
    print_errors(error);
    return 1;
  }
  const auto errors = static_cast<std::size_t>(std::count_if(
      found.begin(), found.end(), [](const Diagnostic& one) { return one.severity == Severity::kError; }));
  if (format == "json") {
    result.print(diagnostics_as_json(found));
  } else if (format == "sarif") {
    result.print(diagnostics_as_sarif(found));
  } else {
    result.print(render(found, result.is_terminal()));
    result.print(fmt::format("{}: {}, {}\n", counted(files, "file"), counted(errors, "error"),
                             counted(found.size() - errors, "warning")));
  }
  return result.finish() && errors == 0 ? 0 : 1;
}

}  // namespace launch
