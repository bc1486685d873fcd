// SPDX-License-Identifier: Apache-2.0
// The programs that are installed beside this one, in lib/launch.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tracing {

// Nothing when it isn't there, as in a build without an install tree.
std::optional<std::filesystem::path> installed_program(const std::string& name);

// Runs it without arguments and output and waits until it has ended. False when it failed.
bool run_program(const std::filesystem::path& program);

// Runs a program that registers with the session daemon, unless this is stopped. Returns when it has ended, after five
// seconds at most, whatever LTTNG_UST_REGISTER_TIMEOUT says.
void run_traced(const std::filesystem::path& program);

// Runs it, in a process group of its own so that a Ctrl-C on the terminal leaves it alone, and returns what it prints
// on stdout without the last line end. "" when it can't be run or fails.
std::string program_output(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace tracing
