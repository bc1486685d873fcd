// The programs that are installed beside this one, in lib/launch.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tracing {

// Nothing when it isn't there, as in a build without an install tree.
std::optional<std::filesystem::path> installed_program(const std::string& name);

// Runs it without arguments and output and waits until it has ended. False when it failed.
bool run_program(const std::filesystem::path& program);

}  // namespace tracing
