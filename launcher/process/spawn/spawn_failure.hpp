// SPDX-License-Identifier: Apache-2.0
// Explains why posix_spawn(3) failed. The kernel's one error number stands for several mistakes: "No such file or
// directory" may mean the program, the interpreter of a script or the working directory.
#pragma once

#include <string>
#include <system_error>

#include "launcher/process/process_spec.hpp"

namespace launch {

// `error` is the error number of the failed start of `program` for `spec`. Looks at the file system to find the reason.
std::system_error spawn_failure(int error, const ProcessSpec& spec, const std::string& program);

}  // namespace launch
