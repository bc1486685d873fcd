// SPDX-License-Identifier: Apache-2.0
// The commands that ask a running launch: `launch ps`, `stop`, `start`, `restart`, `signal`, `shutdown`, `events`,
// `logs`, `top`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/environment/environment.hpp"

namespace launch {

// Whether `command` is one of these.
bool is_control_command(std::string_view command);

// `words` are the words after the name of the command. Returns the exit code: 0, 1 when the launch can't do what it was
// asked for, 2 for a wrong command line.
int control_command(const std::string& command, const std::vector<std::string>& words, const Environment& environment);

// What the shells' completion offers for the word of this number, 1 for the first one after the command: the names of
// the processes of the launches that run, or signals.
std::vector<std::string> control_completions(const std::string& command, std::size_t word,
                                             const Environment& environment);

}  // namespace launch
