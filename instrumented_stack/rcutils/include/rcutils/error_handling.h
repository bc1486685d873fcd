// SPDX-License-Identifier: Apache-2.0
// The error of the current thread: functions that return a failure code leave a message and its place here.
//
// A caller that handles a failure reads the text with rcutils_get_error_string() and then calls rcutils_reset_error().
// Setting an error while another one is still set overwrites it.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_ERROR_STATE_MESSAGE_MAX_LENGTH 768
#define RCUTILS_ERROR_STATE_FILE_MAX_LENGTH 229
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
