// SPDX-License-Identifier: Apache-2.0
// Paths of shared libraries.
#pragma once

#include <filesystem>
#include <string>

#include "rcpputils/env.hpp"
#include "rcpputils/split.hpp"

namespace rcpputils {

// "x" becomes "libx.so".
inline std::string filename_for_library(const std::string& library_name) {
  return "lib" + library_name + ".so";
}

// The library in a directory; empty if it is not there.
inline std::string path_for_library(const std::string& directory, const std::string& library_name) {
  const std::filesystem::path path = std::filesystem::path(directory) / filename_for_library(library_name);
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) ? path.string() : "";
}

// The first one in the directories of LD_LIBRARY_PATH; empty if there is none.
inline std::string find_library_path(const std::string& library_name) {
  for (const std::string& directory : split(get_env_var("LD_LIBRARY_PATH"), ':')) {
    if (std::string path = path_for_library(directory, library_name); !path.empty()) {
      return path;
    }
  }
  return "";
}

}  // namespace rcpputils
