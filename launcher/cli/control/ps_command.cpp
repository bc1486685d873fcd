// SPDX-License-Identifier: Apache-2.0
// `launch ps`: the processes of the launches that run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "launcher/cli/control/commands.hpp"
#include "launcher/cli/control/process_text.hpp"
#include "launcher/cli/subcommand.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/control/control_protocol.hpp"
#include "launcher/control/process_usage.hpp"

namespace launch {
namespace {

using Json = ControlClient::Json;
using ProcessRow = std::array<std::string, 8>;

// As ps(1): the share of a processor since the start.
std::string cpu_text(const std::optional<ProcessUsage>& usage, const Json& process) {
  const double running_for = process.value("running_for", 0.0);
  return usage && running_for > 0 ? fmt::format("{:.1f} %", 100 * usage->cpu / running_for) : "-";
}

ProcessRow row_of(const Json& process, const std::optional<ProcessUsage>& usage) {
  const auto pid = process.find("pid");
  const auto restarts = process.find("restarts");
  return {process["name"].get<std::string>(),
          state_text(process),
          pid == process.end() ? "-" : std::to_string(pid->get<pid_t>()),
          restarts == process.end() ? "-" : std::to_string(restarts->get<std::int64_t>()),
          cpu_text(usage, process),
          usage ? memory_text(usage->memory) : "-",
          pid == process.end() ? "-" : duration_text(process.value("running_for", 0.0)),
          place_text(process["place"])};
}

std::string table(const Json& processes) {
  const std::vector<std::optional<ProcessUsage>> usage = usage_of(processes);
  std::vector<ProcessRow> rows{{"NAME", "STATE", "PID", "RESTARTS", "CPU", "MEMORY", "TIME", "PLACE"}};
  rows.reserve(processes.size() + 1);
  for (std::size_t i = 0; i < processes.size(); ++i) {
    rows.push_back(row_of(processes[i], usage[i]));
  }
  std::array<std::size_t, std::tuple_size_v<ProcessRow>> widths{};
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

std::string heading(const Json& answer) {
  const Json& launch = answer["launch"];
  const double age = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count() -
                     launch["started"].get<double>();
  const std::size_t count = answer["processes"].size();
  const std::string isolation = launch.contains("isolation")
                                    ? fmt::format(", isolated by {}", launch["isolation"].get<std::string>())
                                    : std::string();
  return fmt::format("launch {}: {}, {} for {}, {} process{}{}\n", launch["pid"].get<pid_t>(), files_of(answer),
                     launch["state"].get<std::string>(), duration_text(age), count, count == 1 ? "" : "es", isolation);
}

// The launch that `wanted` names, or all.
std::vector<ControlClient> launches(const Environment& environment, const std::string& wanted) {
  std::vector<ControlClient> all;
  if (!wanted.empty()) {
    all.push_back(choose_launch(environment, wanted));
    return all;
  }
  for (FoundLaunch& found : find_launches(environment)) {
    all.emplace_back(std::move(found));
  }
  return all;
}

}  // namespace

int ps_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment) {
  std::vector<std::string> names;
  std::string wanted;
  bool as_json = false;
  Subcommand command("launch " + name, "Lists the processes of the launches that run.");
  command.take_words("NAME", names, false, "processes, also as patterns such as 'camera*'; all if there is none");
  command.take_text("--launch", wanted, "number or file of the launch; all if it is missing");
  command.take_flag("--json", as_json, "print JSON, see docs/control.md");
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  std::vector<ControlClient> asked = launches(environment, wanted);
  Json answers = Json::array();
  int exit_code = asked.empty() ? 1 : 0;
  for (ControlClient& launch : asked) {
    try {
      Json answer = launch.ask({{"do", "ps"}, {"processes", names}});
      if (as_json) {
        add_usage(answer["processes"]);
      }
      answer.erase("ok");
      answer.erase("version");
      answers.push_back(std::move(answer));
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
    for (std::size_t i = 0; i < answers.size(); ++i) {
      fmt::print("{}{}{}", i == 0 ? "" : "\n", heading(answers[i]), table(answers[i]["processes"]));
    }
  }
  if (asked.empty()) {
    throw ControlError("no launch runs");
  }
  if (answers.empty() && !names.empty()) {
    throw ControlError(fmt::format("no launch has a process of this name: {}", fmt::join(names, ", ")));
  }
  return exit_code;
}

}  // namespace launch
