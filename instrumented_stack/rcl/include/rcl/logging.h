// SPDX-License-Identifier: Apache-2.0
// Sets up the logging of a process from its ROS arguments: levels, console, log file and /rosout.
#pragma once

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/types.h"
#include "rcutils/logging.h"

#ifdef __cplusplus
extern "C" {
#endif

// Applies `--log-level` and the enable/disable flags. Installs the output handler that writes to the console, the log
// file of the process and /rosout.
rcl_ret_t rcl_logging_configure(const rcl_arguments_t* global_args, const rcl_allocator_t* allocator);

// Like rcl_logging_configure(), with another handler. It may call rcl_logging_multiple_output_handler().
rcl_ret_t rcl_logging_configure_with_output_handler(const rcl_arguments_t* global_args,
                                                    const rcl_allocator_t* allocator,
                                                    rcutils_logging_output_handler_t output_handler);
rcl_ret_t rcl_logging_fini(void);
bool rcl_logging_rosout_enabled(void);

void rcl_logging_multiple_output_handler(const rcutils_log_location_t* location, int severity, const char* name,
                                         rcutils_time_point_value_t timestamp, const char* format, va_list* args);

#ifdef __cplusplus
}
#endif
