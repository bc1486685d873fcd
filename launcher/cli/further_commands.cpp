// SPDX-License-Identifier: Apache-2.0
#include "launcher/cli/further_commands.hpp"

#include <fmt/format.h>

#include "launcher/base/nearest_name.hpp"

namespace launch {

const std::vector<CommandInfo>& further_commands() {
  static const std::vector<CommandInfo> commands = {
      {"check", "FILE", "finds errors without running anything"},
      {"events", "", "prints what happens in a running launch"},
      {"explain", "ID", "explains a finding of launch check"},
      {"graph", "FILE", "draws nodes, namespaces, includes and remapped topics"},
      {"logs", "NAME", "prints what the processes of a running launch print"},
      {"ps", "", "lists the processes of the launches that run"},
      {"reference", "", "prints the reference of the launch language"},
      {"report", "DIR", "describes a recorded trace"},
      {"restart", "NAME", "ends processes of a running launch and starts them again"},
      {"schema", "", "prints a schema for editors, or that of the output for programs"},
      {"shutdown", "", "ends a running launch"},
      {"signal", "NAME SIG", "sends a signal to processes of a running launch"},
      {"start", "NAME", "starts processes of a running launch that have ended"},
      {"stop", "NAME", "ends processes of a running launch"},
      {"test", "FILE", "runs the tests of launch files"},
      {"top", "", "shows the processes of a running launch on the whole screen"},
      {"trace", "…", "records a trace by hand, or prints its events"},
  };
  return commands;
}

std::vector<std::string> further_command_names() {
  std::vector<std::string> names;
  for (const CommandInfo& command : further_commands()) {
    names.push_back(command.name);
  }
  return names;
}

std::string list_of_further_commands() {
  std::string text = "Other commands (launch COMMAND --help):\n";
  for (const CommandInfo& command : further_commands()) {
    text += fmt::format("  launch {:<16} {}\n", command.name + " " + command.operand, command.help);
  }
  return text;
}

std::string did_you_mean_command(std::string_view word) {
  const std::string nearest = nearest_name(word, further_command_names());
  return nearest.empty() ? nearest : fmt::format("did you mean the command 'launch {}'?", nearest);
}

}  // namespace launch
