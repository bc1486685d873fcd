// SPDX-License-Identifier: Apache-2.0
#include "base/environment/own_prefix.hpp"

#include <filesystem>
#include <system_error>

namespace launch {

std::string own_prefix() {
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  const bool is_companion = folder.filename() == "launch" && folder.parent_path().filename() == "lib";
  return (is_companion ? folder.parent_path().parent_path() : folder.parent_path()).string();
}

std::string own_library_file(std::string_view name) {
  return own_prefix().append("/lib/launch/").append(name);
}

}  // namespace launch
