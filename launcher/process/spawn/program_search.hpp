// SPDX-License-Identifier: Apache-2.0
// Finds the program of a process, as execvp(3) would, but on the PATH of the process instead of the launcher's.
#pragma once

#include <string>

#include "launcher/process/process_spec.hpp"

namespace launch {

// The path to execute. A name with a slash is returned as it is: the kernel resolves it in the working directory.
// Relative entries of PATH, and empty ones, stand for directories in the working directory of the process.
// Throws std::system_error: ENOENT when no directory of PATH holds the program, EACCES when one does but the file is
// not executable.
std::string find_program(const ProcessSpec& spec);

}  // namespace launch
