// SPDX-License-Identifier: Apache-2.0
// What a logging backend implements: a library `lib<name>.so` with the functions rcl_logging_external_…, which rcl
// loads for RCL_LOGGING_IMPLEMENTATION=<name>. rcl calls them only between initialize and shutdown; log from any
// thread.
#pragma once

#include "rcutils/allocator.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  RCL_LOGGING_RET_OK = 0,
  RCL_LOGGING_RET_ERROR = 2,
  RCL_LOGGING_RET_CONFIG_FILE_DOESNT_EXIST = 21,
  RCL_LOGGING_RET_CONFIG_FILE_INVALID = 22,
} rcl_logging_ret_t;

// `file_name_prefix` is the value of `--log-file-name`, `config_file` that of `--log-config-file`; null without them. A
// failure is told by rcutils_set_error_state().
rcl_logging_ret_t rcl_logging_external_initialize(const char* file_name_prefix, const char* config_file,
                                                  rcutils_allocator_t allocator);
rcl_logging_ret_t rcl_logging_external_shutdown(void);
// `severity` as in rcutils/logging.h; `msg` is the formatted line, without its end.
void rcl_logging_external_log(int severity, const char* name, const char* msg);
// Null is the root of all loggers.
rcl_logging_ret_t rcl_logging_external_set_logger_level(const char* name, int level);

// The folder for log files: ROS_LOG_DIR, else ROS_HOME/log, else ~/.ros/log. The caller frees `*directory`, which must
// be null before.
rcl_logging_ret_t rcl_logging_get_logging_directory(rcutils_allocator_t allocator, char** directory);

#ifdef __cplusplus
}
#endif
