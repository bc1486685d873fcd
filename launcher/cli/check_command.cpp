#include "launcher/cli/check_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <optional>

#include "launcher/cli/check_launch_file.hpp"
#include "launcher/cli/diagnostic_output.hpp"
#include "launcher/cli/find_launch_file.hpp"
#include "launcher/cli/graph.hpp"
#include "launcher/cli/run_command.hpp"
#include "launcher/cli/schema.hpp"
#include "launcher/core/launch_plan.hpp"
#include "launcher/substitution/package_index.hpp"

namespace launch {

namespace {

constexpr int kUsageError = 2;

// Parses, and returns the exit code when that is all there is to do.
std::optional<int> parse(CLI::App& app, std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  try {
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return 0;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}: error: {}\n", app.get_name(), error.what());
    return kUsageError;
  }
  return std::nullopt;
}

struct Target {
  std::vector<std::string> words;
  std::vector<std::pair<std::string, std::string>> arguments;
};

Target split(const std::vector<std::string>& words) {
  Target target;
  for (const std::string& word : words) {
    const std::size_t separator = word.find(":=");
    if (separator == std::string::npos) {
      target.words.push_back(word);
    } else {
      target.arguments.emplace_back(word.substr(0, separator), word.substr(separator + 2));
    }
  }
  return target;
}

// What find_launch_files() needs to look for packages.
Scope scope_of(const Environment& environment) {
  Scope scope;
  scope.environment = environment;
  scope.packages = std::make_shared<PackageIndex>(own_install_prefix());
  return scope;
}

void print_errors(const LaunchError& error) {
  fmt::print(stderr, "{}", render(error.diagnostics(), ::isatty(STDERR_FILENO) != 0));
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

int check_command(const std::vector<std::string>& words, const Registry& registry, const Environment& environment) {
  std::vector<std::string> targets;
  std::string format = "text";
  CheckOptions options;
  CLI::App app(
      "Finds the errors of launch files without running anything: visits them, also what conditions leave out, and "
      "looks for the packages, programs, parameter files and included files that they name. Exit code 1 when there are "
      "errors.",
      "launch check");
  app.add_option("words", targets, "launch files, or a package and a file of it; then arguments, name:=value")
      ->type_name("FILE ... | PACKAGE FILE  [NAME:=VALUE ...]")
      ->required();
  app.add_option("--format", format, "text, json or sarif")
      ->check(CLI::IsMember({"text", "json", "sarif"}))
      ->capture_default_str();
  app.add_flag("--strict-ros2", options.strict_ros2, "what ros2 launch does not know is an error");
  if (const auto exit_code = parse(app, words)) {
    return *exit_code;
  }
  const Target target = split(targets);
  options.arguments = target.arguments;
  if (target.words.empty()) {
    fmt::print(stderr, "launch check: error: no launch file given\n");
    return kUsageError;
  }
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
    fmt::print("{}", diagnostics_as_json(found));
  } else if (format == "sarif") {
    fmt::print("{}", diagnostics_as_sarif(found));
  } else {
    fmt::print("{}{}: {}, {}\n", render(found, ::isatty(STDOUT_FILENO) != 0), counted(files, "file"),
               counted(errors, "error"), counted(found.size() - errors, "warning"));
  }
  return errors == 0 ? 0 : 1;
}

int graph_command(const std::vector<std::string>& words, const Registry& registry, const Environment& environment) {
  std::vector<std::string> targets;
  std::string format = "dot";
  std::string output;
  CLI::App app(
      "Draws what a launch file would run: nodes in their namespaces, processes, included files, remapped names.",
      "launch graph");
  app.add_option("words", targets, "launch files, or a package and a file of it; then arguments, name:=value")
      ->type_name("FILE ... | PACKAGE FILE  [NAME:=VALUE ...]")
      ->required();
  app.add_option("--format", format, "dot, for Graphviz, or svg, drawn by it")
      ->check(CLI::IsMember({"dot", "svg"}))
      ->capture_default_str();
  app.add_option("-o,--output", output, "file to write, instead of standard output");
  if (const auto exit_code = parse(app, words)) {
    return *exit_code;
  }
  const Target target = split(targets);
  if (target.words.empty()) {
    fmt::print(stderr, "launch graph: error: no launch file given\n");
    return kUsageError;
  }
  try {
    LaunchContext context(registry, environment, own_install_prefix(), [](auto, auto, auto) {});
    for (const auto& [name, value] : target.arguments) {
      context.scope().configurations.insert_or_assign(name, value);
    }
    const auto description =
        load_launch_files(find_launch_files(target.words, context.scope()), registry, context.scope());
    const std::string dot = plan_as_dot(plan_launch(context, *description));
    const std::string text = format == "svg" ? dot_as_svg(dot) : dot;
    if (output.empty()) {
      fmt::print("{}", text);
    } else if (!(std::ofstream(output) << text)) {
      throw LaunchError(fmt::format("'{}' can't be written", output), {});
    }
    return 0;
  } catch (const LaunchError& error) {
    print_errors(error);
    return 1;
  }
}

int schema_command(const std::vector<std::string>& words, const Registry& registry) {
  std::string format = "xsd";
  CLI::App app("Prints a schema of the launch language, for editors: XSD for XML files, JSON Schema for YAML files.",
               "launch schema");
  app.add_option("format", format, "xsd or json")->check(CLI::IsMember({"xsd", "json"}))->capture_default_str();
  if (const auto exit_code = parse(app, words)) {
    return *exit_code;
  }
  fmt::print("{}", format == "xsd" ? xml_schema(registry) : json_schema(registry));
  return 0;
}

}  // namespace launch
