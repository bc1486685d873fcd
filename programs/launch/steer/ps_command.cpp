// SPDX-License-Identifier: Apache-2.0
// `launch ps`: the processes of the launches that run.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/environment/own_environment.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/control/control_protocol.hpp"
#include "launcher/control/process_usage.hpp"
#include "launcher/control/ps_answer.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/steer/process_text.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;

constexpr std::size_t kColumns = 8;
using ProcessRow = std::array<std::string, kColumns>;

// As ps(1): the share of a processor since the start.
std::string cpu_text(const ProcessUsage& usage, double running_for) {
  return running_for > 0 ? fmt::format("{:.1f} %", 100 * usage.cpu / running_for) : "-";
}

ProcessRow row_of(const ListedLaunch& launch, const ListedProcess& process, const std::optional<ProcessUsage>& usage) {
  const pid_t pid = process.machine.empty() ? process.pid : process.pid_there;
  const bool runs = pid >= 0;
  return {process.name,
          usage && usage->stopped && process.state == "running"
              ? "stopped"
              : state_text(process.state, process.end, process.health, process.status) +
                    (process.machine.empty() ? "" : " on " + process.machine) + (process.away ? ", which is away" : ""),
          runs ? std::to_string(pid) : "-",
          process.restarts < 0 ? "-" : std::to_string(process.restarts),
          usage ? cpu_text(*usage, process.running_for) : "-",
          usage ? memory_text(usage->memory) + share_text(process.memory_share) : "-",
          runs ? duration_text(process.running_for) : "-",
          process.line == 0 ? "-" : place_text(launch.places[process.file], process.line)};
}

std::string table(const ListedLaunch& launch, const std::vector<std::optional<ProcessUsage>>& usage) {
  std::vector<ProcessRow> rows{{"NAME", "STATE", "PID", "RESTARTS", "CPU", "MEMORY", "TIME", "PLACE"}};
  rows.reserve(launch.processes.size() + 1);
  for (std::size_t i = 0; i < launch.processes.size(); ++i) {
    rows.push_back(row_of(launch, launch.processes[i], usage[i]));
  }
  std::array<std::size_t, kColumns> widths{};
  for (const ProcessRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], columns_of(row[i]));
    }
  }
  std::string text;
  for (const ProcessRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t padding = widths[i] - columns_of(row[i]);
      const bool to_the_right = i >= 2 && i <= 6;
      text.append(i == 0 ? 0 : 2, ' ').append(to_the_right ? padding : 0, ' ').append(row[i]);
      text.append(to_the_right ? 0 : padding, ' ');
    }
    text.erase(text.find_last_not_of(' ') + 1).push_back('\n');
  }
  return text;
}

std::string heading(const ListedLaunch& launch, const std::string& user) {
  std::vector<std::string> files;
  for (const std::string& file : launch.files) {
    files.push_back(std::filesystem::path(file).filename().string());
  }
  const std::size_t count = launch.processes.size();
  return fmt::format("launch {}{}{}: {}, {} for {}, {} process{}{}{}\n", launch.pid, user.empty() ? "" : " of ", user,
                     fmt::join(files, ", "), launch.state, duration_text(launch.running_for), count,
                     count == 1 ? "" : "es", launch.isolation.empty() ? "" : ", isolated by ", launch.isolation);
}

// The launch that `wanted` names, or all.
std::vector<ControlClient> launches(const Environment& environment, const std::string& wanted) {
  std::vector<ControlClient> all;
  if (!wanted.empty()) {
    all.push_back(choose_launch(environment, wanted));
    return all;
  }
  for (FoundLaunch& found : find_launches(environment, WhoseLaunches::kAll)) {
    all.emplace_back(std::move(found));
  }
  return all;
}

}  // namespace

int ps_command(const std::vector<std::string>& words) {
  ::signal(SIGPIPE, SIG_DFL);
  std::vector<std::string> names;
  std::vector<std::string> groups;
  std::string wanted;
  bool as_json = false;
  Subcommand command("launch ps", "Lists the processes of the launches that run.");
  command.take_words("NAME", names, false, "processes, also as patterns such as 'camera*'; all if there is none");
  command.take_texts("--group", groups, "only processes in this <group name=\"…\"> of the launch file");
  command.take_text("--launch", wanted, "number or file of the launch; all if it is missing");
  describe_on_option(command);
  command.take_flag("--json", as_json, "print JSON, see docs/control.md");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  std::vector<ControlClient> asked = launches(own_environment(), wanted);
  std::vector<std::string> tables;
  Json answers = Json::array();
  int exit_code = asked.empty() ? 1 : 0;
  for (ControlClient& launch : asked) {
    try {
      const Json request{{"do", "ps"}, {"processes", names}, {"groups", groups}};
      if (as_json) {
        Json answer = launch.ask(request);
        add_usage(answer["processes"]);
        if (!launch.user().empty()) {
          answer["launch"]["user"] = launch.user();
        }
        answer.erase("ok");
        answer.erase("version");
        answers.push_back(std::move(answer));
      } else {
        UsageReader usage;
        const ListedLaunch listed = read_ps_answer(launch.ask_for_line(request),
                                                   [&usage](const ListedProcess& process) { usage.add(process.pid); });
        tables.push_back(heading(listed, launch.user()) + table(listed, usage.take()));
      }
    } catch (const ControlError& error) {
      // Another launch may have a process of this name.
      if (asked.size() == 1) {
        throw;
      }
      if (names.empty()) {
        fmt::print(stderr, "{}", command_error("launch ps", error.what(), error.help()));
        exit_code = 1;
      }
    }
  }
  if (as_json) {
    fmt::print("{}\n", Json{{"version", kControlVersion}, {"launches", answers}}.dump(2));
  } else {
    fmt::print("{}", fmt::join(tables, "\n"));
  }
  if (asked.empty()) {
    throw ControlError("no launch runs");
  }
  if (answers.empty() && tables.empty() && !names.empty()) {
    throw ControlError(fmt::format("no launch has a process of this name: {}", fmt::join(names, ", ")));
  }
  return exit_code;
}

}  // namespace launch
