// SPDX-License-Identifier: Apache-2.0
// Commands of $(command …) that are not run, because somebody only looks at the launch file.
#pragma once

#include <string_view>

namespace launch {

// What stands for the output of such a command. No real name has it.
inline constexpr std::string_view kUnknownOutput = "\x1A";

// From now on no command of this process is run. That a program is missing is still an error.
void leave_commands_out();

// Whether a command was left out since the last call of forget_left_out_command().
bool command_was_left_out();
void forget_left_out_command();

}  // namespace launch
