// SPDX-License-Identifier: Apache-2.0
// The error of the current thread: functions that return a failure code leave a message and its place here.
//
// A caller that handles a failure reads the text with rcutils_get_error_string() and then calls rcutils_reset_error().
// Setting an error while another one is still set overwrites it.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rcutils/allocator.h"
#include "rcutils/macros.h"
#include "rcutils/snprintf.h"
#include "rcutils/testing/fault_injection.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_ERROR_STATE_MESSAGE_MAX_LENGTH 768
#define RCUTILS_ERROR_STATE_FILE_MAX_LENGTH 229
#define RCUTILS_ERROR_STATE_LINE_NUMBER_STR_MAX_LENGTH 20  // of the largest 64-bit number
#define RCUTILS_ERROR_FORMATTING_CHARACTERS 6              // `, at ` and `:`
#define RCUTILS_ERROR_MESSAGE_MAX_LENGTH 1024

typedef struct rcutils_error_state_s {
  char message[RCUTILS_ERROR_STATE_MESSAGE_MAX_LENGTH];
  char file[RCUTILS_ERROR_STATE_FILE_MAX_LENGTH];
  uint64_t line_number;
} rcutils_error_state_t;

// `message, at file:line`, cut to fit.
typedef struct rcutils_error_string_s {
  char str[RCUTILS_ERROR_MESSAGE_MAX_LENGTH];
} rcutils_error_string_t;

// For threads that must not allocate later. Here the memory is part of each thread from its start.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_initialize_error_handling_thread_local_storage(rcutils_allocator_t allocator);

bool rcutils_error_is_set(void);

// The error state of this thread; null if no error is set.
const rcutils_error_state_t* rcutils_get_error_state(void);

// The text of this thread's error; `error not set` if there is none.
rcutils_error_string_t rcutils_get_error_string(void);

void rcutils_reset_error(void);

void rcutils_set_error_state(const char* error_string, const char* file, size_t line_number);

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void rcutils_set_formatted_error_state(const char* file, size_t line_number, const char* format, ...);

#define RCUTILS_SET_ERROR_MSG(msg) rcutils_set_error_state((msg), __FILE__, __LINE__)
#define RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING(...) rcutils_set_formatted_error_state(__FILE__, __LINE__, __VA_ARGS__)

// These put the text of the error that is set behind the new text.
#define RCUTILS_SET_ERROR_MSG_AND_APPEND_PREV_ERROR(msg)                           \
  do {                                                                             \
    const rcutils_error_string_t rcutils_previous = rcutils_get_error_string();    \
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("%s: %s", msg, rcutils_previous.str); \
  } while (0)
#define RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING_AND_APPEND_PREV_ERROR(format_string, ...)             \
  do {                                                                                                 \
    const rcutils_error_string_t rcutils_previous = rcutils_get_error_string();                        \
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING(format_string ": %s", __VA_ARGS__, rcutils_previous.str); \
  } while (0)

// These write to stderr. The last two take the error that is set away and write its text, too.
#define RCUTILS_SAFE_FWRITE_TO_STDERR(msg)          \
  do {                                              \
    fwrite(msg, sizeof(char), strlen(msg), stderr); \
  } while (0)
#define RCUTILS_SAFE_FWRITE_TO_STDERR_WITH_FORMAT_STRING(format_string, ...)                         \
  do {                                                                                               \
    char rcutils_output[RCUTILS_ERROR_MESSAGE_MAX_LENGTH];                                           \
    if (rcutils_snprintf(rcutils_output, sizeof(rcutils_output), format_string, __VA_ARGS__) >= 0) { \
      RCUTILS_SAFE_FWRITE_TO_STDERR(rcutils_output);                                                 \
    }                                                                                                \
  } while (0)
#define RCUTILS_SAFE_FWRITE_TO_STDERR_AND_APPEND_PREV_ERROR(msg)                    \
  do {                                                                              \
    const rcutils_error_string_t rcutils_previous = rcutils_get_error_string();     \
    rcutils_reset_error();                                                          \
    RCUTILS_SAFE_FWRITE_TO_STDERR(msg);                                             \
    RCUTILS_SAFE_FWRITE_TO_STDERR_WITH_FORMAT_STRING(": %s", rcutils_previous.str); \
  } while (0)
#define RCUTILS_SAFE_FWRITE_TO_STDERR_WITH_FORMAT_STRING_AND_APPEND_PREV_ERROR(format_string, ...) \
  do {                                                                                             \
    const rcutils_error_string_t rcutils_previous = rcutils_get_error_string();                    \
    rcutils_reset_error();                                                                         \
    RCUTILS_SAFE_FWRITE_TO_STDERR_WITH_FORMAT_STRING(format_string, __VA_ARGS__);                  \
    RCUTILS_SAFE_FWRITE_TO_STDERR_WITH_FORMAT_STRING(": %s", rcutils_previous.str);                \
  } while (0)

#define RCUTILS_CAN_SET_MSG_AND_RETURN_WITH_ERROR_OF(error_return_value)             \
  RCUTILS_CAN_FAIL_WITH({                                                            \
    RCUTILS_SET_ERROR_MSG("fault injected: " RCUTILS_STRINGIFY(error_return_value)); \
    return error_return_value;                                                       \
  })

#define RCUTILS_CHECK_FOR_NULL_WITH_MSG(value, msg, error_statement) \
  do {                                                               \
    if ((value) == NULL) {                                           \
      RCUTILS_SET_ERROR_MSG(msg);                                    \
      error_statement;                                               \
    }                                                                \
  } while (0)

#define RCUTILS_CHECK_ARGUMENT_FOR_NULL(argument, error_return_type) \
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(argument, #argument " argument is null", return error_return_type)

#ifdef __cplusplus
}
#endif
