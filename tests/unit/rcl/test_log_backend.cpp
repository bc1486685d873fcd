// SPDX-License-Identifier: Apache-2.0
// A logging backend that writes its calls to the file TEST_LOG_BACKEND.
#include <cstdlib>
#include <fstream>
#include <string>

#include "rcl_logging_interface/rcl_logging_interface.h"
#include "rcutils/error_handling.h"

namespace {

void record(const std::string& line) {
  std::ofstream(std::getenv("TEST_LOG_BACKEND"), std::ios::app) << line << "\n";
}

}  // namespace

rcl_logging_ret_t rcl_logging_external_initialize(const char* file_name_prefix, const char* config_file,
                                                  rcutils_allocator_t) {
  if (std::string(config_file == nullptr ? "" : config_file) == "wrong") {
    RCUTILS_SET_ERROR_MSG("'wrong' is no file");
    return RCL_LOGGING_RET_CONFIG_FILE_DOESNT_EXIST;
  }
  record(std::string("initialize ") + (file_name_prefix == nullptr ? "null" : file_name_prefix));
  return RCL_LOGGING_RET_OK;
}

rcl_logging_ret_t rcl_logging_external_shutdown(void) {
  record("shutdown");
  return RCL_LOGGING_RET_OK;
}

void rcl_logging_external_log(int severity, const char* name, const char* msg) {
  record("log " + std::to_string(severity) + " " + name + " '" + msg + "'");
}

rcl_logging_ret_t rcl_logging_external_set_logger_level(const char* name, int level) {
  record(std::string("level ") + (name == nullptr ? "null" : name) + " " + std::to_string(level));
  return RCL_LOGGING_RET_OK;
}
