// SPDX-License-Identifier: Apache-2.0
// Finds shared libraries where the dynamic linker would.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// The path of the library with this file name, or "". Looks in LD_LIBRARY_PATH, the directories of /etc/ld.so.conf and
// the standard ones, in this order, see ld.so(8).
std::string find_shared_library(const std::string& file_name);

// The directories that an ld.so.conf(5) file names, `include` lines followed. A file that can't be read names none.
std::vector<std::string> read_linker_configuration(const std::string& file);

}  // namespace tracing
