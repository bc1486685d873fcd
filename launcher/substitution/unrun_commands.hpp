// SPDX-License-Identifier: Apache-2.0
// Commands of $(command …) that are not run, because somebody only looks at the launch file.
#pragma once

#include <string_view>

namespace launch {

// What stands for the output of such a command, and for other values that only a run knows. No real name has it.
inline constexpr std::string_view kUnknownOutput = "\x1A";

// Belongs to a scope and its copies (scope.hpp). No command is run in them. That a program is missing is still an
// error.
struct UnrunCommands {
  bool left_out = false;  // a command was left out since somebody last looked
};

}  // namespace launch
