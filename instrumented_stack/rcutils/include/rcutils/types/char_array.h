// SPDX-License-Identifier: Apache-2.0
// A C string that grows.
#pragma once

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcutils_char_array_s {
  char* buffer;
  bool owns_buffer;      // otherwise the buffer belongs to somebody else, and a larger one is a new one
  size_t buffer_length;  // with the 0 at the end
  size_t buffer_capacity;
  rcutils_allocator_t allocator;
} rcutils_char_array_t;

RCUTILS_WARN_UNUSED rcutils_char_array_t rcutils_get_zero_initialized_char_array(void);

RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_init(rcutils_char_array_t* char_array, size_t buffer_capacity,
                                                          const rcutils_allocator_t* allocator);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_fini(rcutils_char_array_t* char_array);

// Changes the capacity; it cannot be 0.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_resize(rcutils_char_array_t* char_array, size_t new_size);

// Makes the capacity at least so large.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_expand_as_needed(rcutils_char_array_t* char_array,
                                                                      size_t new_size);

// These replace the text, or append to it.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_vsprintf(rcutils_char_array_t* char_array, const char* format,
                                                              va_list args);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_memcpy(rcutils_char_array_t* char_array, const char* src,
                                                            size_t n);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_strcpy(rcutils_char_array_t* char_array, const char* src);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_strncat(rcutils_char_array_t* char_array, const char* src,
                                                             size_t n);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_char_array_strcat(rcutils_char_array_t* char_array, const char* src);

#ifdef __cplusplus
}
#endif
