// SPDX-License-Identifier: Apache-2.0
// Which LTTng helper libraries a process must preload for its userspace events to fire, and to fork safely with them.
// Finds these libraries where the dynamic linker would.
#pragma once

#include <string>
#include <vector>

namespace tracing {

// The path of the library with this file name, or "". Looks in LD_LIBRARY_PATH, the directories of /etc/ld.so.conf and
// the standard ones, in this order, see ld.so(8).
std::string find_shared_library(const std::string& file_name);

// The directories that an ld.so.conf(5) file names, `include` lines followed. A file that can't be read names none.
std::vector<std::string> read_linker_configuration(const std::string& file);

// Those of /etc/ld.so.conf and the standard ones, in this order: where the dynamic linker looks at last.
std::vector<std::string> standard_library_folders();

struct PreloadPlan {
  std::vector<std::string> libraries;  // paths, in the order of preloading
  std::vector<std::string> warnings;   // a library that is not installed, two profilers at once
};

// `find_library` gives the path of a library by its file name, or "" when it is not there; by default the dynamic
// linker's directories are searched.
PreloadPlan plan_preload(const std::vector<std::string>& events_ust);
PreloadPlan plan_preload(const std::vector<std::string>& events_ust, std::string (*find_library)(const std::string&));

// LD_PRELOAD with the libraries appended, separated by colons. A library that is already in it is not repeated.
std::string append_preload(const std::string& current, const std::vector<std::string>& libraries);

}  // namespace tracing
