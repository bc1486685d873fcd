// SPDX-License-Identifier: Apache-2.0
// In which namespace of process ids this process runs. The kernel's tracer has the numbers of the first one.
#pragma once

#include <filesystem>
#include <system_error>

namespace tracing {

// False where /proc does not tell.
inline bool is_in_first_pid_namespace() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/ns/pid", error) == "pid:[4026531836]";
}

}  // namespace tracing
