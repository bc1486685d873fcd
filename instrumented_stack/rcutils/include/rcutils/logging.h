// SPDX-License-Identifier: Apache-2.0
// Log levels per logger and the line written to the console for each message.
//
// Logger names are hierarchical: `a.b` inherits the level of `a`, which inherits the default level. A message that
// passes its logger's level goes to the output handler, by default rcutils_logging_console_output_handler(); rcl
// installs one that also publishes it on /rosout.
//
// Environment, read at initialization:
//   RCUTILS_CONSOLE_OUTPUT_FORMAT  line format, default `[{severity}] [{time}] [{name}]: {message}`; tokens are
//     severity name message function_name file_name line_number time time_as_nanoseconds date_time_with_ms
//   RCUTILS_COLORIZED_OUTPUT       0 or 1; by default colours only on a terminal
//   RCUTILS_LOGGING_USE_STDOUT     1 writes to stdout instead of stderr
// RCUTILS_LOGGING_BUFFERED_STREAM  1 buffers the stream by lines, 0 not at all; the default leaves it as it is
//
// Every function is thread safe. The output handler is called without a lock held.
#pragma once

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/error_handling.h"
#include "rcutils/macros.h"
#include "rcutils/time.h"
#include "rcutils/types/char_array.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_LOGGING_SEPARATOR_CHAR '.'
#define RCUTILS_LOGGING_SEPARATOR_STRING "."

enum RCUTILS_LOG_SEVERITY {
  RCUTILS_LOG_SEVERITY_UNSET = 0,
  RCUTILS_LOG_SEVERITY_DEBUG = 10,
  RCUTILS_LOG_SEVERITY_INFO = 20,
  RCUTILS_LOG_SEVERITY_WARN = 30,
  RCUTILS_LOG_SEVERITY_ERROR = 40,
  RCUTILS_LOG_SEVERITY_FATAL = 50,
};

#define RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL RCUTILS_LOG_SEVERITY_INFO

typedef struct rcutils_log_location_s {
  const char* function_name;
  const char* file_name;
  size_t line_number;
} rcutils_log_location_t;

typedef void (*rcutils_logging_output_handler_t)(const rcutils_log_location_t* location, int severity, const char* name,
                                                 rcutils_time_point_value_t timestamp, const char* format,
                                                 va_list* args);

// Reads the environment. The first logging function calls it; further calls do nothing. Returns
// RCUTILS_RET_INVALID_ARGUMENT if a variable has an invalid value; logging then works with defaults.
rcutils_ret_t rcutils_logging_initialize(void);

// The same; the memory here comes from no allocator, but it must be a valid one.
rcutils_ret_t rcutils_logging_initialize_with_allocator(rcutils_allocator_t allocator);
extern bool g_rcutils_logging_initialized;

// Forgets levels and settings, and restores the console output handler.
rcutils_ret_t rcutils_logging_shutdown(void);

rcutils_logging_output_handler_t rcutils_logging_get_output_handler(void);
void rcutils_logging_set_output_handler(rcutils_logging_output_handler_t handler);

int rcutils_logging_get_default_logger_level(void);

// UNSET restores RCUTILS_DEFAULT_LOGGER_DEFAULT_LEVEL.
void rcutils_logging_set_default_logger_level(int level);

// The level set for exactly this name, UNSET if there is none, -1 on error. The empty name is the default logger.
int rcutils_logging_get_logger_level(const char* name);

// The same for the first `name_length` characters of a name.
int rcutils_logging_get_logger_leveln(const char* name, size_t name_length);

rcutils_ret_t rcutils_logging_set_logger_level(const char* name, int level);

// The level of the nearest ancestor that has one; else the default level.
int rcutils_logging_get_logger_effective_level(const char* name);

bool rcutils_logging_logger_is_enabled_for(const char* name, int severity);

// Accepts `debug`, `INFO`… in any case. Returns RCUTILS_RET_LOGGING_SEVERITY_STRING_INVALID for another word.
rcutils_ret_t rcutils_logging_severity_level_from_string(const char* severity_string, rcutils_allocator_t allocator,
                                                         int* severity);

// `DEBUG`, `INFO`…; null if the number is not a severity.
const char* rcutils_logging_severity_name(int severity);

// The names by number; null where the number is not a severity.
extern const char* const g_rcutils_log_severity_names[RCUTILS_LOG_SEVERITY_FATAL + 1];

// Replaces `logging_output` by the line for a message in the configured format, without colours and a newline.
rcutils_ret_t rcutils_logging_format_message(const rcutils_log_location_t* location, int severity, const char* name,
                                             rcutils_time_point_value_t timestamp, const char* msg,
                                             rcutils_char_array_t* logging_output);

// Passes a message to the output handler if the logger is enabled for the severity.
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void rcutils_log(const rcutils_log_location_t* location, int severity, const char* name, const char* format, ...);

// Like rcutils_log(), but does not check the level: for macros that have already checked it.
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void rcutils_log_internal(const rcutils_log_location_t* location, int severity, const char* name, const char* format,
                          ...);

// Writes one line to the console in the configured format. The line goes out in a single write.
void rcutils_logging_console_output_handler(const rcutils_log_location_t* location, int severity, const char* name,
                                            rcutils_time_point_value_t timestamp, const char* format, va_list* args);

#define RCUTILS_LOGGING_AUTOINIT (void)rcutils_logging_initialize()
#define RCUTILS_LOGGING_AUTOINIT_WITH_ALLOCATOR(alloc) (void)rcutils_logging_initialize_with_allocator(alloc)

#ifdef __cplusplus
}
#endif
