// SPDX-License-Identifier: Apache-2.0
// `launch stop`, `start`, `restart`, `signal`, `shutdown`: each waits until it has happened.
#include <fmt/format.h>
#include <poll.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>
#include <cstdio>
#include <set>
#include <system_error>
#include <utility>

#include "base/diagnostics/diagnostic.hpp"
#include "base/environment/own_environment.hpp"
#include "base/files/unique_fd.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/steer/process_text.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

constexpr std::size_t kMostCopies = 1000;
constexpr const char* kNamesHelp = "names of processes or their nodes, also as patterns such as 'camera*'";

std::string description_of(const std::string& name) {
  if (name == "stop") {
    return "Ends processes of a running launch, and waits for their end: SIGINT, after their timeouts SIGTERM and "
           "SIGKILL. They do not respawn.";
  }
  return name == "start" ? "Starts processes of a running launch that have ended."
                         : "Ends processes of a running launch and starts them again.";
}

// Prints what has not been done. Returns the exit code.
int report(const std::string& name, const Json& outcome) {
  for (const Json& text : outcome["refused"]) {
    fmt::print(stderr, "{}", command_error("launch " + name, text.get<std::string>()));
  }
  for (const Json& process : outcome["dropped"]) {
    fmt::print("{} will not start\n", process.get<std::string>());
  }
  return outcome["done"].empty() && outcome["dropped"].empty() ? 1 : 0;
}

// Says what has happened to a process. Returns whether there is nothing more to wait for, and sets `failed`.
bool tell(const std::string& name, const std::string& process, const Json& event, bool& failed) {
  const std::string what = event.value("event", "");
  if (name == "stop") {
    if (what == "exited") {
      fmt::print("{} has ended: {}\n", process, end_text(event));
    }
    return what == "done";
  }
  if (what == "started") {
    fmt::print("{} has started, pid {}\n", process, event.value("pid", 0));
    return true;
  }
  if (what == "start_failed" || what == "done") {
    const std::string reason = event.contains("error") ? ": " + event["error"].get<std::string>() : "";
    fmt::print(stderr, "{}", command_error("launch " + name, process + " has not started" + reason));
    failed = true;
    return true;
  }
  return false;
}

int steer(const std::string& name, const std::vector<std::string>& words) {
  std::vector<std::string> names;
  std::vector<std::string> groups;
  std::string wanted;
  bool no_wait = false;
  Subcommand command("launch " + name, description_of(name));
  command.take_words("NAME", names, false, kNamesHelp);
  command.take_texts("--group", groups,
                     "processes in this <group name=\"…\"> of the launch file, and in groups within it");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  command.take_flag("--no-wait", no_wait, "only ask, don't wait until it has happened");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (names.empty() && groups.empty()) {
    fmt::print(stderr, "{}",
               usage_error("launch " + name, "NAME is required", "--group means a whole group of the launch file"));
    return kWrongCommandLine;
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  if (!no_wait) {
    launch.ask("events");
  }
  const Json outcome = launch.ask({{"do", name}, {"processes", names}, {"groups", groups}});
  const int exit_code = report(name, outcome);
  bool failed = false;
  std::set<std::string> pending;
  for (const Json& process : outcome["done"]) {
    pending.insert(process.get<std::string>());
  }
  while (!no_wait && !pending.empty()) {
    const std::optional<Json> event = launch.next();
    if (!event) {
      throw ControlError(fmt::format("launch {} has ended", launch.pid()));
    }
    const std::string process = event->value("process", "");
    if (pending.count(process) != 0 && tell(name, process, *event, failed)) {
      pending.erase(process);
    }
  }
  return failed ? 1 : exit_code;
}

}  // namespace

int stop_command(const std::vector<std::string>& words) {
  return steer("stop", words);
}

int start_command(const std::vector<std::string>& words) {
  return steer("start", words);
}

int restart_command(const std::vector<std::string>& words) {
  return steer("restart", words);
}

int scale_command(const std::vector<std::string>& words) {
  std::string process;
  std::string number;
  std::string wanted;
  Subcommand command(
      "launch scale",
      "Lets so many of a process run that is declared scalable=\"true\": starts copies, or ends the last ones.");
  command.take_text("NAME", process, "name of a process or its node");
  command.take_text("N", number, "how many shall run, the first one included");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  if (process.empty() || number.empty() || error != std::errc() || end != number.data() + number.size() || count == 0 ||
      count > kMostCopies) {
    fmt::print(
        stderr, "{}",
        process.empty() || number.empty()
            ? usage_error("launch scale", "NAME and N are required")
            : usage_error("launch scale", fmt::format("N is a number from 1 to {}, not '{}'", kMostCopies, number),
                          number == "0" ? "launch stop ends a process" : ""));
    return kWrongCommandLine;
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  const Json outcome = launch.ask({{"do", "scale"}, {"processes", {process}}, {"count", count}});
  for (const Json& done : outcome["done"]) {
    fmt::print("{}\n", done.get<std::string>());
  }
  return 0;
}

int signal_command(const std::vector<std::string>& words) {
  std::string process;
  std::string signal;
  std::string wanted;
  Subcommand command("launch signal", "Sends a signal to processes of a running launch, with their groups.");
  command.take_text("NAME", process, kNamesHelp);
  command.take_text("SIGNAL", signal, "its name or number, such as SIGUSR1, USR1 or 10");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (process.empty() || signal.empty()) {
    fmt::print(stderr, "{}", usage_error("launch signal", "NAME and SIGNAL are required"));
    return kWrongCommandLine;
  }
  const int number = signal_number(signal);
  if (number == 0) {
    fmt::print(stderr, "{}",
               usage_error("launch signal", fmt::format("there is no signal '{}'", signal),
                           did_you_mean(signal, signal_names())));
    return kWrongCommandLine;
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  const Json outcome = launch.ask({{"do", "signal"}, {"processes", {process}}, {"signal", std::to_string(number)}});
  for (const Json& done : outcome["done"]) {
    fmt::print("{} got SIG{}\n", done.get<std::string>(), ::sigabbrev_np(number));
  }
  return report("signal", outcome);
}

int shutdown_command(const std::vector<std::string>& words) {
  std::string wanted;
  bool no_wait = false;
  Subcommand command("launch shutdown", "Ends a running launch as Ctrl-C does, and waits until nothing of it is left.");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  command.take_flag("--no-wait", no_wait, "only ask, don't wait until it has happened");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  // The process that the user has started ends last.
  const UniqueFd whole(static_cast<int>(::syscall(SYS_pidfd_open, launch.pid(), 0)));
  launch.ask("shutdown");
  if (!no_wait && whole) {
    pollfd ended{whole.get(), POLLIN, 0};
    while (::poll(&ended, 1, -1) != 1) {
    }
    fmt::print("launch {} has ended\n", launch.pid());
  }
  return 0;
}

}  // namespace launch
