// SPDX-License-Identifier: Apache-2.0
// `launch check`: finds the errors of launch files without running them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "actions/builtin_actions.hpp"
#include "base/environment/own_environment.hpp"
#include "base/environment/own_prefix.hpp"
#include "launcher/invocation/find_launch_file.hpp"
#include "launcher/python/interpreter/python_guest.hpp"
#include "launcher/substitution/package_index.hpp"
#include "programs/command_line/result_output.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/check/check_launch_file.hpp"
#include "programs/launch/check/diagnostic_output.hpp"
#include "programs/launch/check/finding_baseline.hpp"
#include "programs/launch/check/finding_table.hpp"
#include "programs/launch/command_functions.hpp"

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

// The words, with the launch files below a directory in its place. A directory without any is a finding. A package and
// the name of its launch file stay as they are, even if a directory has the name of the package.
std::vector<std::string> expand_directories(const std::vector<std::string>& words, std::vector<Diagnostic>& found) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  std::error_code unreadable;
  if (words.size() == 2 && !fs::exists(words.back(), unreadable)) {
    return words;
  }
  for (const std::string& word : words) {
    if (!fs::is_directory(word, unreadable)) {
      files.push_back(word);
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(files.size());
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(word, unreadable)) {
      if (is_launch_file(entry.path()) && entry.is_regular_file(unreadable)) {
        files.push_back(entry.path().string());
      }
    }
    if (static_cast<std::size_t>(first) == files.size()) {
      found.push_back({Severity::kError,
                       fmt::format("there are no launch files in '{}'", word),
                       {},
                       "their names end in launch.xml, launch.yaml, launch.yml or launch.py",
                       Finding::kUnreadableFile});
    }
    std::sort(files.begin() + first, files.end());
  }
  return files;
}

// The files to check. A word that is none is a finding, and the others are checked all the same.
std::vector<std::string> files_of(const std::vector<std::string>& words, const Scope& scope,
                                  std::vector<Diagnostic>& found) {
  const auto note = [&](LaunchError& error) {
    error.classify(Finding::kUnreadableFile);
    found.insert(found.end(), error.diagnostics().begin(), error.diagnostics().end());
  };
  try {
    return find_launch_files(words, scope, listed_command_names());
  } catch (LaunchError& error) {
    std::error_code ignored;
    if (words.size() == 1 || (words.size() == 2 && !std::filesystem::exists(words.front(), ignored))) {
      note(error);
      return {};
    }
  }
  std::vector<std::string> files;
  for (const std::string& word : words) {
    try {
      const std::vector<std::string> file = find_launch_files({word}, scope, listed_command_names());
      files.insert(files.end(), file.begin(), file.end());
    } catch (LaunchError& error) {
      note(error);
    }
  }
  return files;
}

// What the options of the command line say of the findings.
struct Choice {
  std::vector<std::string> disabled;  // ids
  bool warnings_are_errors = false;

  // Throws LaunchError for an id that there is not.
  void apply(std::vector<Diagnostic>& found) const {
    for (const std::string& id : disabled) {
      const std::optional<Finding> finding = find_finding(id);
      if (!finding) {
        throw unknown_finding(id);
      }
      std::erase_if(found, [&](const Diagnostic& diagnostic) { return diagnostic.finding == *finding; });
    }
    for (Diagnostic& diagnostic : found) {
      diagnostic.severity = warnings_are_errors ? Severity::kError : diagnostic.severity;
    }
  }
};

}  // namespace

int check_command(const std::vector<std::string>& words) {
  const Registry registry = builtin_actions();
  const Environment environment = own_environment();
  std::string format = "text";
  CheckOptions options;
  LaunchTarget target;
  Choice choice;
  Subcommand command(
      "launch check",
      "Finds the errors of launch files, or of all launch files below a directory, without running anything: visits "
      "them, including actions that conditions leave "
      "out, and looks for the packages, programs, parameter files and included files that they name. Exit code 1 when "
      "there are errors.");
  command.take_target(target);
  command.take_choice("--format", format, {"text", "json", "sarif", "github", "gitlab"},
                      "text; json; sarif; github: annotations of GitHub Actions; gitlab: a report for Code Quality");
  std::string baseline;
  command.take_text("--baseline", baseline, "leave out the findings in this file, so that new ones are left");
  std::string new_baseline;
  command.take_text("--write-baseline", new_baseline, "write the findings into this file, and exit with 0");
  command.take_flag("--strict-ros2", options.strict_ros2,
                    "tags and attributes that ros2 launch does not know are errors");
  command.take_flag("--werror", choice.warnings_are_errors, "warnings are errors");
  std::string trace;
  command.take_text("--from-trace", trace,
                    "a trace of a run: also warn of remaps of names that the recorded nodes do not have");
  std::vector<std::string> dumps;
  command.take_texts(
      "--from-parameters", dumps,
      "what launch param dump has printed of nodes: also warn of parameters that these nodes do not have; may be "
      "given several times");
  command.take_texts("--disable", choice.disabled,
                     "leave out the findings with this id; may be given several times (launch explain lists the ids)");
  std::vector<std::string> enabled;
  command.take_texts("--enable", enabled, "also look for the findings with this id, which are off otherwise: LF0209");
  PythonLimits python;
  command.take_python_limits(python);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  run_python_in_a_guest({std::chrono::seconds(python.seconds), python.memory});
  std::vector<Diagnostic> found;
  try {
    choice.apply(found);
    for (const std::string& id : enabled) {
      const std::optional<Finding> finding = find_finding(id);
      if (!finding) {
        throw unknown_finding(id);
      }
      options.finds_leaks = options.finds_leaks || *finding == Finding::kLeak;
    }
  } catch (const LaunchError& error) {
    print_usage_error(error, "launch check");
    return kWrongCommandLine;
  }
  if (!trace.empty()) {
    std::optional<std::vector<RecordedNode>> recorded = read_recorded_nodes(trace);
    if (!recorded) {
      return 1;
    }
    options.recorded_nodes = std::move(*recorded);
  }
  try {
    for (const std::string& dump : dumps) {
      read_recorded_parameters(dump, options.recorded_parameters);
    }
  } catch (const LaunchError& error) {
    print_errors(error, "launch check");
    return 1;
  }
  ResultOutput result("launch check");
  options.arguments = target.arguments;
  const std::vector<std::string> words_of_files = expand_directories(target.words, found);
  const std::vector<std::string> files =
      words_of_files.empty() ? words_of_files : files_of(words_of_files, scope_of(environment), found);
  for (const std::string& path : files) {
    const std::vector<Diagnostic> of_file = check_launch_file(path, registry, environment, options);
    found.insert(found.end(), of_file.begin(), of_file.end());
  }
  choice.apply(found);
  std::string of_baseline;
  try {
    if (!new_baseline.empty()) {
      write_baseline(new_baseline, found);
      fmt::print(stderr, "launch check: {} written to {}\n", counted(found.size(), "finding"), new_baseline);
      return 0;
    }
    if (!baseline.empty()) {
      const ComparedWithBaseline compared = leave_out_known(baseline, found);
      of_baseline = fmt::format(", {} of the baseline{}", counted(compared.known, "finding"),
                                compared.gone == 0 ? "" : fmt::format(" ({} of it gone)", compared.gone));
    }
  } catch (const LaunchError& error) {
    print_errors(error, "launch check");
    return 1;
  }
  const auto errors = static_cast<std::size_t>(std::count_if(
      found.begin(), found.end(), [](const Diagnostic& one) { return one.severity == Severity::kError; }));
  if (format == "json") {
    result.print(diagnostics_as_json(found));
  } else if (format == "sarif") {
    result.print(diagnostics_as_sarif(found));
  } else if (format == "github") {
    result.print(diagnostics_for_github(found));
  } else if (format == "gitlab") {
    result.print(diagnostics_for_gitlab(found));
  } else {
    result.print(diagnostics_as_text(found, result.has_colour()));
    result.print(fmt::format("{}: {}, {}{}\n", counted(files.size(), "file"), counted(errors, "error"),
                             counted(found.size() - errors, "warning"), of_baseline));
  }
  return result.finish() && errors == 0 ? 0 : 1;
}

}  // namespace launch
