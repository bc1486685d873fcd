// SPDX-License-Identifier: Apache-2.0
// `launch events` and `launch logs`: what happens in a running launch, and what its processes print.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <fstream>
#include <set>

#include "base/environment/own_environment.hpp"
#include "launcher/control/control_client.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

// "1700000000.1234567 [talker-1] text" gives "[talker-1] text" if the line is one of a process that was asked for. The
// launcher's own lines have a level first: "1700000000.1234567 [INFO] [talker-1]: text".
std::string_view line_of(std::string_view stamped, const std::set<std::string, std::less<>>& names) {
  const std::size_t stamp = stamped.find(' ');
  if (stamp == std::string_view::npos || !stamped.substr(stamp + 1).starts_with('[')) {
    return {};
  }
  const std::string_view line = stamped.substr(stamp + 1);
  const std::size_t end = line.find(']');
  return end != std::string_view::npos && names.find(line.substr(1, end - 1)) != names.end() ? line
                                                                                             : std::string_view();
}

// The lines of processes in launch.log, up to its byte `size`.
std::deque<std::string> past_lines(const std::string& log, std::size_t size,
                                   const std::set<std::string, std::less<>>& names, std::size_t most) {
  std::deque<std::string> lines;
  std::ifstream file(log);
  std::size_t read = 0;
  for (std::string line; read < size && std::getline(file, line); read += line.size() + 1) {
    if (const std::string_view text = line_of(line, names); !text.empty()) {
      lines.emplace_back(text);
      if (lines.size() > most) {
        lines.pop_front();
      }
    }
  }
  return lines;
}

}  // namespace

int events_command(const std::vector<std::string>& words) {
  ::signal(SIGPIPE, SIG_DFL);  // `launch events | head` ends quietly
  std::string wanted;
  bool follow = false;
  Subcommand command("launch events", "Prints what happens in a running launch as JSON lines, until it ends.");
  command.take_flag("-f,--follow", follow, "accepted, the command always follows");
  command.take_text("--launch", wanted, kLaunchHelp);
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
  for (const Json& process : asked["processes"]) {
    labels.insert(process["name"].get<std::string>());
  }
  const std::string log = asked["launch"]["log_file"].get<std::string>();
  std::size_t size = static_cast<std::size_t>(-1);
  if (follow) {
    size = launch.ask({{"do", "output"}, {"processes", names}})["log_size"].get<std::size_t>();
  }
  for (const std::string& line : past_lines(log, size, labels, count)) {
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
      fmt::print("[{}] {}\n", event->value("process", ""), event->value("line", ""));
    }
  }
  return 0;
}

}  // namespace launch
