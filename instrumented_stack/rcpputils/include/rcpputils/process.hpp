// SPDX-License-Identifier: Apache-2.0
// The current process.
#pragma once

#include <errno.h>

#include <string>

namespace rcpputils {

// The name of the executable without its folder.
inline std::string get_executable_name() {
  return program_invocation_short_name;
}

}  // namespace rcpputils
