// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/further_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text/nearest_name.hpp"

namespace launch {

const std::vector<CommandInfo>& further_commands() {
  static const std::vector<CommandInfo> commands = {
      {"action", "VERB", "lists and describes actions, and sends goals"},
      {"build", "PACKAGE", "builds the packages of a workspace"},
      {"check", "FILE", "finds errors without running anything"},
      {"clock", "", "publishes simulated time on /clock"},
      {"component", "VERB", "lists, loads and unloads components"},
      {"events", "", "prints what happens in a running launch"},
      {"explain", "ID", "explains a finding of launch check"},
      {"graph", "FILE", "draws nodes, namespaces, includes and remapped topics"},
      {"interface", "VERB", "shows the messages, services and actions that are installed"},
      {"lifecycle", "VERB", "shows and changes the states of nodes with a life cycle"},
      {"loglevel", "NODE", "prints or sets the level of the loggers of nodes"},
      {"logs", "NAME", "prints what the processes of a running launch print"},
      {"node", "VERB", "lists and describes nodes"},
      {"param", "VERB", "lists, prints and sets parameters of nodes"},
      {"ps", "", "lists the processes of the launches that run"},
      {"reference", "", "prints the reference of the launch language"},
      {"report", "DIR", "describes a recorded trace"},
      {"restart", "NAME", "ends processes of a running launch and starts them again"},
      {"run", "PKG PROGRAM", "runs a program of a package on this terminal"},
      {"schema", "", "prints a schema for editors, or that of the output for programs"},
      {"service", "VERB", "lists, describes and calls services"},
      {"shutdown", "", "ends a running launch"},
      {"signal", "NAME SIG", "sends a signal to processes of a running launch"},
      {"start", "NAME", "starts processes of a running launch that have ended"},
      {"stop", "NAME", "ends processes of a running launch"},
      {"test", "FILE", "runs the tests of launch files"},
      {"top", "", "shows the processes of a running launch on the whole screen"},
      {"topic", "VERB", "lists, prints, measures and publishes topics of ROS 2"},
      {"trace", "…", "records a trace by hand, or prints its events"},
  };
  return commands;
}

bool is_ros_command(std::string_view command) {
  constexpr std::array<std::string_view, 10> kCommands = {"action",   "clock", "component", "interface", "lifecycle",
                                                          "loglevel", "node",  "param",     "service",   "topic"};
  return std::find(kCommands.begin(), kCommands.end(), command) != kCommands.end();
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
