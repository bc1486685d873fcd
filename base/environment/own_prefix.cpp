// SPDX-License-Identifier: Apache-2.0
#include "base/environment/own_prefix.hpp"

#include <filesystem>
#include <system_error>

namespace launch {

std::string own_prefix() {
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  const bool is_in_lib = folder.parent_path().filename() == "lib" &&
                         (folder.filename() == "launch" || folder.filename() == "launch_companion");
  return (is_in_lib ? folder.parent_path().parent_path() : folder.parent_path()).string();
}

std::string own_library_file(std::string_view name) {
  return own_prefix().append("/lib/launch/").append(name);
}

std::string needs_missing_file(std::string_view name) {
  std::string text = "needs ";
  text.append(name).append(", which is not in ").append(own_prefix()).append("/lib/launch");
  // The parts of a build that it may be without (cmake/Parts.cmake).
  if (name.starts_with("launch-ros-")) {
    text += ": this installation has been built without the stack";
  } else if (name == "launch-test") {
    text += ": this installation has been built without tests in launch files";
  } else if (name == "launch-serve") {
    text += ": this installation has been built without it (libmicrohttpd-dev was missing)";
  } else if (name == "launch-twin") {
    text += ": the package launch-twin has it";
  } else if (name == "launch-trace-probe") {
    text += ": this installation has been built without tracepoints";
  }
  return text;
}

}  // namespace launch
