// SPDX-License-Identifier: Apache-2.0
// `launch gdb` and `launch stack`: a debugger on a process of a running launch, and what all its threads do now.
#include <errno.h>
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/environment/own_environment.hpp"
#include "base/processes/spawn.hpp"
#include "launcher/control/control_client.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/remote/on_option.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using Json = ControlClient::Json;

struct Debugged {
  std::string label;
  pid_t pid;
  std::string program;
};

bool is_installed(const std::string& program) {
  const Environment environment = own_environment();
  const auto path = environment.find("PATH");
  std::istringstream directories(path == environment.end() ? "/usr/bin:/bin" : path->second);
  for (std::string directory; std::getline(directories, directory, ':');) {
    if (::access((fs::path(directory) / program).c_str(), X_OK) == 0) {
      return true;
    }
  }
  return false;
}

std::string program_of(pid_t pid) {
  std::error_code error;
  std::string program = fs::read_symlink(fmt::format("/proc/{}/exe", pid), error).string();
  constexpr std::string_view kDeleted = " (deleted)";
  if (program.ends_with(kDeleted)) {
    program.resize(program.size() - kDeleted.size());
  }
  return program;
}

std::vector<pid_t> children_of(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/task/{}/children", pid, pid));
  return {std::istream_iterator<pid_t>(file), std::istream_iterator<pid_t>()};
}

// A shell, or a command in front such as nice, stands between: the program is its only child.
Debugged program_below(std::string label, pid_t pid) {
  static constexpr std::string_view kInFront[] = {"sh",      "bash",   "dash", "nice",   "ionice",
                                                  "timeout", "stdbuf", "env",  "taskset"};
  for (std::vector<pid_t> children; (children = children_of(pid)).size() == 1; pid = children.front()) {
    const std::string name = fs::path(program_of(pid)).filename().string();
    if (std::find(std::begin(kInFront), std::end(kInFront), name) == std::end(kInFront)) {
      break;
    }
  }
  return {std::move(label), pid, program_of(pid)};
}

// The processes of this name that run. Throws ControlError if none does.
std::vector<Debugged> find_running(const std::string& name, const std::string& wanted) {
  ControlClient launch = choose_launch(own_environment(), wanted);
  const Json answer = launch.ask({{"do", "ps"}, {"processes", {name}}});
  std::vector<Debugged> found;
  std::string machine;
  for (const Json& process : answer["processes"]) {
    if (process.contains("pid")) {
      found.push_back(program_below(process["name"].get<std::string>(), process["pid"].get<pid_t>()));
    } else if (process.contains("pid_there")) {
      machine = process["machine"].get<std::string>();
    }
  }
  if (found.empty() && !machine.empty()) {
    throw ControlError(fmt::format("'{}' runs on machine '{}', which a debugger here does not reach", name, machine));
  }
  if (found.empty()) {
    throw ControlError(fmt::format("'{}' does not run", name), "launch start starts it");
  }
  return found;
}

// Why this user may not look into the process; empty: it may.
std::string why_refused(const Debugged& process) {
  std::ifstream maps(fmt::format("/proc/{}/maps", process.pid));
  if (::geteuid() == 0) {
    return "";
  }
  if (!maps || maps.peek() == std::ifstream::traits_type::eof()) {
    return fmt::format("{} (pid {}) belongs to another user, or does not let others look into it", process.label,
                       process.pid);
  }
  std::ifstream file("/proc/sys/kernel/yama/ptrace_scope");
  int scope = 0;
  return file >> scope && scope > 0
             ? fmt::format("this machine lets no debugger attach to {} (kernel.yama.ptrace_scope is {})", process.label,
                           scope)
             : "";
}

void require_rights(const Debugged& process, const std::string& command) {
  if (const std::string why = why_refused(process); !why.empty()) {
    throw ControlError(
        why, fmt::format("use 'sudo {} {} --launch NUMBER', or allow it: sudo sysctl kernel.yama.ptrace_scope=0",
                         command, process.label));
  }
}

}  // namespace

int gdb_command(const std::vector<std::string>& words) {
  std::string name;
  std::string wanted;
  Subcommand command("launch gdb", "Runs gdb on a process of a running launch. It goes on when gdb is left.");
  command.take_text("NAME", name, "name of a process or its node");
  command.take_text("--launch", wanted, kLaunchHelp);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (name.empty()) {
    fmt::print(stderr, "{}", usage_error("launch gdb", "NAME is required"));
    return kWrongCommandLine;
  }
  const std::vector<Debugged> found = find_running(name, wanted);
  if (found.size() > 1) {
    std::string labels;
    for (const Debugged& process : found) {
      labels += (labels.empty() ? "" : ", ") + process.label;
    }
    throw ControlError(fmt::format("several processes are named '{}': {}", name, labels), "name one of them");
  }
  if (!is_installed("gdb")) {
    throw ControlError("gdb is not installed", "the package gdb has it: sudo apt install gdb");
  }
  const Debugged& process = found.front();
  require_rights(process, "launch gdb");
  fmt::print("{}: pid {}, {}\n", process.label, process.pid, process.program);
  std::fflush(stdout);
  const std::string pid = std::to_string(process.pid);
  ::execlp("gdb", "gdb", "-q", "-p", pid.c_str(), process.program.empty() ? nullptr : process.program.c_str(), nullptr);
  throw ControlError(fmt::format("gdb can't be started: {}", ::strerror(errno)));
}

int stack_command(const std::vector<std::string>& words) {
  std::string name;
  std::string wanted;
  Subcommand command("launch stack",
                     "Prints what all threads of a process do now. The process stands still for a moment meanwhile.");
  command.take_text("NAME", name, "name of a process or its node, also a pattern such as 'camera*'");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (name.empty()) {
    fmt::print(stderr, "{}", usage_error("launch stack", "NAME is required"));
    return kWrongCommandLine;
  }
  const std::vector<Debugged> found = find_running(name, wanted);
  const bool has_gdb = is_installed("gdb");
  if (!has_gdb && !is_installed("eu-stack")) {
    throw ControlError("neither gdb nor eu-stack is installed",
                       "the packages gdb and elfutils have them: sudo apt install gdb");
  }
  int exit_code = 0;
  for (const Debugged& process : found) {
    require_rights(process, "launch stack");
    fmt::print("{}{}: pid {}, {}\n", &process == &found.front() ? "" : "\n", process.label, process.pid,
               process.program);
    std::fflush(stdout);
    const std::string pid = std::to_string(process.pid);
    const std::vector<std::string> argv = has_gdb ? std::vector<std::string>{"gdb",
                                                                             "--batch",
                                                                             "--nx",
                                                                             "-iex",
                                                                             "set debuginfod enabled off",
                                                                             "-ex",
                                                                             "set pagination off",
                                                                             "-p",
                                                                             pid,
                                                                             "-ex",
                                                                             "thread apply all backtrace"}
                                                  : std::vector<std::string>{"eu-stack", "-p", pid};
    const int status = wait_for(spawn({.program = argv.front(), .argv = argv, .search_path = true}));
    if (status != 0) {
      fmt::print(stderr, "{}",
                 command_error("launch stack", fmt::format("{} could not look into {}", argv.front(), process.label)));
      exit_code = 1;
    }
  }
  return exit_code;
}

}  // namespace launch
