// SPDX-License-Identifier: Apache-2.0
#include "rcutils/error_handling.h"

#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace {

thread_local bool is_set = false;
thread_local rcutils_error_state_t state;

// The file name is enough for a reader, and does not depend on the machine.
const char* base_name(const char* path) {
  const char* slash = std::strrchr(path, '/');
  return slash == nullptr ? path : slash + 1;
}

void set_place(const char* file, size_t line) {
  std::snprintf(state.file, sizeof(state.file), "%s", file == nullptr ? "" : base_name(file));
  state.line_number = line;
  is_set = true;
}

}  // namespace

rcutils_ret_t rcutils_initialize_error_handling_thread_local_storage(rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&allocator, "invalid allocator", return RCUTILS_RET_INVALID_ARGUMENT)
  return RCUTILS_RET_OK;
}

bool rcutils_error_is_set(void) {
  return is_set;
}

const rcutils_error_state_t* rcutils_get_error_state(void) {
  return is_set ? &state : nullptr;
}

rcutils_error_string_t rcutils_get_error_string(void) {
  rcutils_error_string_t text;
  if (is_set) {
    std::snprintf(text.str, sizeof(text.str), "%s, at %s:%" PRIu64, state.message, state.file, state.line_number);
  } else {
    std::snprintf(text.str, sizeof(text.str), "error not set");
  }
  return text;
}

void rcutils_reset_error(void) {
  is_set = false;
}

void rcutils_set_error_state(const char* error_string, const char* file, size_t line_number) {
  rcutils_set_formatted_error_state(file, line_number, "%s", error_string == nullptr ? "" : error_string);
}

void rcutils_set_formatted_error_state(const char* file, size_t line_number, const char* format, ...) {
  // Formatted into a separate buffer, because an argument may be the text of the error that is being replaced.
  char message[sizeof(state.message)];
  va_list args;
  va_start(args, format);
  std::vsnprintf(message, sizeof(message), format, args);
  va_end(args);
  std::memcpy(state.message, message, sizeof(message));
  set_place(file, line_number);
}
