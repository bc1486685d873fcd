// SPDX-License-Identifier: Apache-2.0
// The commands of the launcher other than running a launch file: for the help, the completion and suggestions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launch {

struct CommandInfo {
  std::string name;
  std::string operand;  // as the help shows it
  std::string help;     // one line
};

const std::vector<CommandInfo>& further_commands();

// Whether launch-ros-command does it.
bool is_ros_command(std::string_view command);

std::vector<std::string> further_command_names();

// "Other commands:" and a line for each.
std::string list_of_further_commands();

// "did you mean the command 'launch check'?", or "" when no command is near enough to the word.
std::string did_you_mean_command(std::string_view word);

}  // namespace launch
