// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/steer/control_command.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <utility>

#include "base/diagnostics/command_error.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "programs/launch/steer/commands.hpp"

namespace launch {
namespace {

struct ControlCommand {
  const char* name;
  int (*run)(const std::string& name, const std::vector<std::string>& words, const Environment& environment);
};

constexpr std::array<ControlCommand, 9> kControlCommands{{{"ps", ps_command},
                                                          {"stop", steer_command},
                                                          {"start", steer_command},
                                                          {"restart", steer_command},
                                                          {"signal", signal_command},
                                                          {"shutdown", shutdown_command},
                                                          {"events", events_command},
                                                          {"logs", logs_command},
                                                          {"top", top_command}}};

// Labels and other names of the processes of all launches.
std::vector<std::string> process_names(const Environment& environment) {
  std::set<std::string> names;
  for (FoundLaunch& found : find_launches(environment)) {
    try {
      const ControlClient::Json answer = ControlClient(std::move(found)).ask("ps");
      for (const ControlClient::Json& process : answer["processes"]) {
        names.insert(process["name"].get<std::string>());
        for (const ControlClient::Json& name : process["names"]) {
          names.insert(name.get<std::string>());
        }
      }
    } catch (const ControlError&) {
      // Its names are not to be had.
    }
  }
  return {names.begin(), names.end()};
}

const ControlCommand* find_command(std::string_view name) {
  const auto* const found = std::find_if(kControlCommands.begin(), kControlCommands.end(),
                                         [&](const ControlCommand& command) { return name == command.name; });
  return found == kControlCommands.end() ? nullptr : found;
}

}  // namespace

bool is_control_command(std::string_view command) {
  return find_command(command) != nullptr;
}

std::vector<std::string> control_completions(const std::string& command, std::size_t word,
                                             const Environment& environment) {
  if (command == "signal" && word > 1) {
    return signal_names();
  }
  return command == "shutdown" || command == "events" ? std::vector<std::string>() : process_names(environment);
}

int control_command(const std::string& name, const std::vector<std::string>& words, const Environment& environment) {
  // `launch events | head` ends quietly.
  ::signal(SIGPIPE, SIG_DFL);
  try {
    return find_command(name)->run(name, words, environment);
  } catch (const ControlError& error) {
    fmt::print(stderr, "{}", command_error("launch " + name, error.what(), error.help()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}", command_error("launch " + name, error.what()));
  }
  return 1;
}

}  // namespace launch
