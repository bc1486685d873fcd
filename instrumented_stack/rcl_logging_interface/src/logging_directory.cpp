// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <string>

#include "rcl_logging_interface/rcl_logging_interface.h"
#include "rcutils/error_handling.h"
#include "rcutils/strdup.h"

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// A leading ~ becomes the home directory; it is removed if HOME is not set.
std::string with_home(const std::string& path) {
  return path.starts_with('~') ? variable("HOME") + path.substr(1) : path;
}

std::string logging_directory() {
  if (const std::string directory = variable("ROS_LOG_DIR"); !directory.empty()) {
    return with_home(directory);
  }
  const std::string home = variable("ROS_HOME");
  return with_home(home.empty() ? "~/.ros" : home) + "/log";
}

}  // namespace

rcl_logging_ret_t rcl_logging_get_logging_directory(rcutils_allocator_t allocator, char** directory) {
  if (directory == nullptr || *directory != nullptr) {
    RCUTILS_SET_ERROR_MSG("the directory must be a null pointer, given by its address");
    return RCL_LOGGING_RET_ERROR;
  }
  *directory = rcutils_strdup(logging_directory().c_str(), allocator);
  if (*directory == nullptr) {
    RCUTILS_SET_ERROR_MSG("out of memory for the name of the log directory");
    return RCL_LOGGING_RET_ERROR;
  }
  return RCL_LOGGING_RET_OK;
}
