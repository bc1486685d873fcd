// SPDX-License-Identifier: Apache-2.0
// The command line of `launch FILE` and `launch PACKAGE FILE`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "programs/command_line/subcommand.hpp"

namespace launch {

enum class CommandMode { kRun, kShowArguments, kPrint, kDryRunText, kDryRunJson, kDryRunShell };

struct CommandLine {
  CommandMode mode = CommandMode::kRun;
  std::vector<std::string> words;                              // the command line as it was given
  std::vector<std::string> target;                             // paths, or a package and a file name
  std::vector<std::pair<std::string, std::string>> arguments;  // name:=value, in order
  bool debug = false;
  bool timing = false;
  bool report = false;  // make a page of each trace
  bool trace = false;   // record the launch also when its file has no <trace>
  bool strict_arguments = false;
  bool show_all_output = false;
  bool top = false;  // show the launch in launch top
  bool ignore_failures = false;
  bool isolate = false;  // give the launch a network and shared memory of its own
  bool contain = false;  // put the launch into a process namespace
  bool timestamps = false;
  bool reload_on_hangup = false;
  bool watch = false;                                // reload when a launch file changes
  std::string log_file_name;                         // of launch.log; without ".log", too
  std::uint64_t log_size = std::uint64_t{64} << 20;  // bytes; 0: no limit
  std::string keep_logs;                             // of earlier launches (old_logs.hpp)
  int log_files = 5;
  std::vector<std::pair<std::string, std::string>> log_levels;  // of nodes: name or "", level
  std::vector<std::string> machine_files;                       // visited before the others, by --machines
  std::map<std::string, std::string> machines;                  // the command that leads to each, by --machine
  std::string crash_directory;
  std::string launch_prefix;
  std::string launch_prefix_filter;
  PythonLimits python;
};

// The exit code when there is nothing to run: after --help, --version or a wrong command line. The text is already
// printed.
struct ExitNow {
  int code;
};

// `words` are those after `launch`.
std::variant<CommandLine, ExitNow> parse_command_line(const std::vector<std::string>& words);

}  // namespace launch
