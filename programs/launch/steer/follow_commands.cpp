// SPDX-License-Identifier: Apache-2.0
// `launch events` and `launch logs`: what happens in a running launch, and what its processes print.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "base/environment/own_environment.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/control/log_lines.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/remote/on_option.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

}  // namespace

int events_command(const std::vector<std::string>& words) {
  ::signal(SIGPIPE, SIG_DFL);  // `launch events | head` ends quietly
  std::string wanted;
  bool follow = false;
  Subcommand command("launch events", "Prints what happens in a running launch as JSON lines, until it ends.");
  command.take_flag("-f,--follow", follow, "accepted, the command always follows");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  launch.ask("events");
  while (const std::optional<Json> event = launch.next()) {
    fmt::print("{}\n", event->dump());
    std::fflush(stdout);
  }
  return 0;
}

int logs_command(const std::vector<std::string>& words) {
  ::signal(SIGPIPE, SIG_DFL);
  std::vector<std::string> names;
  std::string wanted;
  bool follow = false;
  std::string most = "all";
  Subcommand command("launch logs", "Prints what the processes of a running launch have printed.");
  command.take_words("NAME", names, false, "processes, also as patterns such as 'camera*'; all if there is none");
  command.take_flag("-f,--follow", follow, "go on with what they print from now on, until the launch ends");
  command.take_text("-n,--lines", most, "only the last lines, so many");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  std::size_t count = static_cast<std::size_t>(-1);
  if (most != "all") {
    const bool is_number = !most.empty() && most.size() <= 9 &&
                           std::all_of(most.begin(), most.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!is_number) {
      fmt::print(stderr, "{}", usage_error("launch logs", "--lines needs a number"));
      return kWrongCommandLine;
    }
    count = std::stoul(most);
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  const Json asked = launch.ask({{"do", "ps"}, {"processes", names}});
  std::set<std::string, std::less<>> labels;
  std::map<std::string, std::string> shown;  // by the names of the processes: what stands in front of their lines
  for (const Json& process : asked["processes"]) {
    const auto name = process["name"].get<std::string>();
    const std::string machine = process.value("machine", "");
    labels.insert(shown[name] = machine.empty() ? name : machine + ":" + name);
  }
  const std::string log = asked["launch"]["log_file"].get<std::string>();
  std::size_t size = static_cast<std::size_t>(-1);
  if (follow) {
    size = launch.ask({{"do", "output"}, {"processes", names}})["log_size"].get<std::size_t>();
  }
  for (const std::string& line : past_lines(log, {0, size}, labels, count)) {
    fmt::print("{}\n", line);
  }
  while (follow) {
    std::fflush(stdout);
    const std::optional<Json> event = launch.next();
    if (!event) {
      break;
    }
    if (event->value("event", "") == "dropped") {
      fmt::print(stderr, "launch logs: warning: {} lines came too fast, launch.log has them\n",
                 event->value("lines", 0));
    } else {
      const std::string name = event->value("process", "");
      fmt::print("[{}] {}\n", shown.contains(name) ? shown.at(name) : name, event->value("line", ""));
    }
  }
  return 0;
}

}  // namespace launch
