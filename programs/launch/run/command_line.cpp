// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/run/command_line.hpp"

#include <errno.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "base/diagnostics/command_error.hpp"
#include "launcher/process/output/old_logs.hpp"
#include "programs/command_line/size_option.hpp"
#include "programs/launch/commands.hpp"

namespace launch {

namespace {

constexpr std::array<std::string_view, 5> kLevels = {"debug", "info", "warn", "error", "fatal"};

constexpr const char* kDescription =
    "Runs a ROS 2 launch file (XML, YAML or Python): starts its traces and processes, and supervises them to the end.";

constexpr const char* kExamples =
    "\n"
    "Examples:\n"
    "  launch system.launch.xml rate:=20\n"
    "  launch launch_examples 01_ping_pong.launch.yaml\n"
    "  launch --show-args system.launch.xml\n"
    "  launch --dry-run system.launch.xml\n";

ExitNow wrong_use(const std::string& message) {
  fmt::print(stderr, "{}", usage_error("launch", message));
  return {kWrongCommandLine};
}

}  // namespace

std::variant<CommandLine, ExitNow> parse_command_line(const std::vector<std::string>& words_of_user) {
  CommandLine command;
  command.words = words_of_user;
  command.words.insert(command.words.begin(), ::program_invocation_name);
  std::vector<std::string> words;
  std::string dry_run;
  bool show_arguments = false;
  bool print = false;
  bool noninteractive = false;
  std::vector<std::string> log_levels;
  std::vector<std::string> machines;

  CLI::App app(kDescription, "launch");
  app.footer(list_of_commands() + kExamples);
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
  app.add_flag("--top", command.top, "begin in the full-screen view of launch top; q leaves it, the launch goes on");
  app.add_flag("--isolate", command.isolate,
               "give the launch a network and shared memory of its own, or a ROS domain where that is not allowed");
  app.add_flag("--contain", command.contain,
               "put the launch into a process namespace: the kernel ends what is left, whoever is killed");
  app.add_flag("--ignore-failures", command.ignore_failures,
               "exit with 0 also if processes have failed, as ros2 launch does");
  app.add_flag("--reload-on-hup", command.reload_on_hangup,
               "read the launch file again on SIGHUP, as launch reload does, instead of ending");
  app.add_flag("--watch", command.watch, "read the launch file again whenever it changes, or a file that it includes");
  app.add_flag("--timestamps", command.timestamps, "put the time in front of every line on the screen");
  app.add_option("--log-level", log_levels,
                 "debug, info, warn, error or fatal for the loggers of all nodes; NODE:=LEVEL for those of one")
      ->type_name("[NODE:=]LEVEL")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app.add_option("--log-file-name", command.log_file_name, "the name of the log file, launch.log by default")
      ->type_name("NAME")
      ->check(CLI::Validator(
          [](const std::string& name) {
            return name.empty() || name.find('/') != std::string::npos ? std::string("a name without '/' is needed")
                                                                       : std::string();
          },
          ""));
  app.add_option("--log-size", command.log_size,
                 "begin a new log file when one has this size: bytes, or with K, M or G; 64M by default, 0: never")
      ->type_name("SIZE")
      ->transform(size_in_bytes());
  app.add_option("--log-files", command.log_files, "how many files of each log are kept, 5 by default")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  app.add_option("--keep-logs", command.keep_logs,
                 "how many log directories of earlier launches are kept, how long, and of which size; 200,90d,4G by "
                 "default, or all")
      ->type_name("LIMITS");
  app.add_option("--crash-dir", command.crash_directory,
                 "make a directory in DIR for each crash: core, backtrace, last output, command")
      ->type_name("DIR");
  add_python_limits(app, command.python);
  app.add_flag("-n,--noninteractive", noninteractive, "accepted for compatibility; signals are always passed on");
  app.add_option("--machine", machines,
                 "the command that leads to a machine, in place of its `connect` in the launch file; NAME=local: this "
                 "machine")
      ->type_name("NAME=COMMAND")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app.add_option("--machines", command.machine_files,
                 "a launch file with `machine` and `assign_machine`, which is visited before the others")
      ->type_name("FILE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app.add_option("--launch-prefix", command.launch_prefix, "command line put in front of every process, such as gdb");
  app.add_option("--launch-prefix-filter", command.launch_prefix_filter,
                 "regular expression; only programs whose name it matches get the prefix");
  try {
    app.parse(std::vector<std::string>(words_of_user.rbegin(), words_of_user.rend()));
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return ExitNow{0};
  } catch (const CLI::CallForVersion& version) {
    fmt::print("launch {}\n", version.what());
    return ExitNow{0};
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}", usage_error_of(app, error));
    return ExitNow{kWrongCommandLine};
  }

  if (!command.keep_logs.empty()) {
    try {
      parse_log_limits(command.keep_logs);
    } catch (const std::invalid_argument& error) {
      return wrong_use(fmt::format("--keep-logs: {}", error.what()));
    }
  }
  for (const std::string& wish : log_levels) {
    const std::size_t separator = wish.find(":=");
    const std::string level = separator == std::string::npos ? wish : wish.substr(separator + 2);
    if (std::find(kLevels.begin(), kLevels.end(), level) == kLevels.end() || separator == 0) {
      return wrong_use(
          fmt::format("--log-level {} is unknown, expected {} or NODE:=LEVEL", wish, fmt::join(kLevels, ", ")));
    }
    command.log_levels.emplace_back(separator == std::string::npos ? "" : wish.substr(0, separator), level);
  }
  for (const std::string& given : machines) {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos || equals == 0 || given.find_first_not_of(" \t", equals + 1) == std::string::npos) {
      return wrong_use(
          fmt::format("--machine {} is no machine, expected NAME=COMMAND, such as 'arm=ssh robot2'", given));
    }
    command.machines.insert_or_assign(given.substr(0, equals), given.substr(equals + 1));
  }
  for (const std::string& word : words) {
    const std::size_t separator = word.find(":=");
    if (separator == std::string::npos && command.arguments.empty()) {
      command.target.push_back(word);
    } else if (separator == std::string::npos || separator == 0) {
      return wrong_use(fmt::format("malformed launch argument '{}', expected format '<name>:=<value>'", word));
    } else {
      command.arguments.emplace_back(word.substr(0, separator), word.substr(separator + 2));
    }
  }
  if (command.target.empty()) {
    return wrong_use("no launch file given");
  }
  if (int(!dry_run.empty()) + int(show_arguments) + int(print) > 1) {
    return wrong_use("--dry-run, --show-args and --print exclude each other");
  }
  if ((command.watch || command.reload_on_hangup) &&
      std::find(command.target.begin(), command.target.end(), "-") != command.target.end()) {
    return wrong_use(fmt::format("{} needs a launch file, standard input can't be read again",
                                 command.watch ? "--watch" : "--reload-on-hup"));
  }
  if (!command.launch_prefix_filter.empty() && command.launch_prefix.empty()) {
    return wrong_use("--launch-prefix-filter needs --launch-prefix");
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
    return wrong_use(fmt::format("--dry-run={} is unknown, expected text, json or shell", dry_run));
  }
  return command;
}

}  // namespace launch
