// SPDX-License-Identifier: Apache-2.0
// Finds the program of a process, and says why it could not be started. The search is that of execvp(3), but on the
// PATH of the process instead of the launcher's.
#pragma once

#include <string>
#include <system_error>

#include "launcher/process/process_spec.hpp"

namespace launch {

// The path to execute. A name with a slash is returned as it is: the kernel resolves it in the working directory.
// Relative entries of PATH, and empty ones, stand for directories in the working directory of the process.
// Throws std::system_error: ENOENT when no directory of PATH holds the program, EACCES when one does but the file is
// not executable.
std::string find_program(const ProcessSpec& spec);

// Explains why posix_spawn(3) failed. The kernel's one error number stands for several mistakes: "No such file or
// directory" may mean the program, the interpreter of a script or the working directory.
// `error` is the error number of the failed start of `program` for `spec`. Looks at the file system to find the reason.
std::system_error spawn_failure(int error, const ProcessSpec& spec, const std::string& program);

}  // namespace launch
