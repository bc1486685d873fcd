// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

namespace launch {

namespace {

constexpr int kUsageError = 2;

constexpr const char* kDescription =
    "Runs a ROS 2 launch file (XML, YAML or Python): starts its traces and processes, and supervises them to the end.";

constexpr const char* kFooter =
    "Other commands:\n"
    "  launch trace …    records a trace by hand (launch trace --help)\n"
    "  launch report DIR describes a recorded trace (launch report --help)\n"
    "  launch check FILE finds errors without running anything (launch check --help)\n"
    "  launch explain ID explains a finding of launch check (launch explain --help)\n"
    "  launch graph FILE draws nodes, namespaces, includes and remapped topics (launch graph --help)\n"
    "  launch schema     prints a schema for editors (launch schema --help)\n"
    "  launch reference  prints the reference of the launch language\n"
    "\n"
    "Examples:\n"
    "  launch system.launch.xml rate:=20\n"
    "  launch launch_examples 01_ping_pong.launch.yaml\n"
    "  launch --show-args system.launch.xml\n"
    "  launch --dry-run system.launch.xml\n";

ExitNow usage_error(const std::string& message) {
  fmt::print(stderr, "launch: error: {}\n", message);
  return {kUsageError};
}

}  // namespace

std::variant<CommandLine, ExitNow> parse_command_line(int argc, const char* const* argv) {
  CommandLine command;
  command.words.assign(argv, argv + argc);
  std::vector<std::string> words;
  std::string dry_run;
  bool show_arguments = false;
  bool print = false;
  bool noninteractive = false;

  CLI::App app(kDescription, "launch");
  app.footer(kFooter);
  app.set_version_flag("--version", LAUNCH_VERSION);
  app.add_option("words", words,
                 "launch files, - for standard input, or a package and a file of it; then arguments, name:=value")
      ->type_name("FILE ... | PACKAGE FILE  [NAME:=VALUE ...]");
  app.add_flag("-s,--show-args,--show-arguments", show_arguments, "print the file's arguments, don't run it");
  app.add_flag("-p,--print,--print-description", print, "print the actions of the file, don't run it");
  app.add_flag("--dry-run{text}", dry_run,
               "print what would run, don't run it; --dry-run=json for programs, --dry-run=shell as a script");
  app.add_flag("-d,--debug", command.debug, "show debug messages");
  app.add_flag("--trace", command.trace,
               "record a trace with the default settings, unless the file has a trace of its own");
  app.add_flag("--report", command.report, "make a page of the trace at its end and print its path; includes --trace");
  app.add_flag("--timing", command.timing, "print how long each step of the start took");
  app.add_flag("-a,--show-all-subprocesses-output", command.show_all_output,
               "show the output of every process on the screen and in launch.log");
  app.add_flag("--strict-args", command.strict_arguments,
               "arguments that the file does not declare, or that are given twice, are errors");
  app.add_flag("-n,--noninteractive", noninteractive, "accepted for compatibility; signals are always passed on");
  app.add_option("--launch-prefix", command.launch_prefix, "command line put in front of every process, such as gdb");
  app.add_option("--launch-prefix-filter", command.launch_prefix_filter,
                 "regular expression; only programs whose name it matches get the prefix");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return ExitNow{0};
  } catch (const CLI::CallForVersion& version) {
    fmt::print("launch {}\n", version.what());
    return ExitNow{0};
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what());
  }

  for (const std::string& word : words) {
    const std::size_t separator = word.find(":=");
    if (separator == std::string::npos && command.arguments.empty()) {
      command.target.push_back(word);
    } else if (separator == std::string::npos || separator == 0 || separator + 2 == word.size()) {
      return usage_error(fmt::format("malformed launch argument '{}', expected format '<name>:=<value>'", word));
    } else {
      command.arguments.emplace_back(word.substr(0, separator), word.substr(separator + 2));
    }
  }
  if (command.target.empty()) {
    return usage_error("no launch file given, see launch --help");
  }
  if (int(!dry_run.empty()) + int(show_arguments) + int(print) > 1) {
    return usage_error("--dry-run, --show-args and --print exclude each other");
  }
  if (!command.launch_prefix_filter.empty() && command.launch_prefix.empty()) {
    return usage_error("--launch-prefix-filter needs --launch-prefix");
  }
  if (show_arguments) {
    command.mode = CommandMode::kShowArguments;
  } else if (print) {
    command.mode = CommandMode::kPrint;
  } else if (dry_run == "text") {
    command.mode = CommandMode::kDryRunText;
  } else if (dry_run == "json") {
    command.mode = CommandMode::kDryRunJson;
  } else if (dry_run == "shell") {
    command.mode = CommandMode::kDryRunShell;
  } else if (!dry_run.empty()) {
    return usage_error(fmt::format("--dry-run={} is unknown, expected text, json or shell", dry_run));
  }
  return command;
}

}  // namespace launch
