// SPDX-License-Identifier: Apache-2.0
// An owned array of C strings.
#pragma once

#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcutils_string_array_s {
  size_t size;
  char** data;
  rcutils_allocator_t allocator;
} rcutils_string_array_t;

rcutils_string_array_t rcutils_get_zero_initialized_string_array(void);

// Makes room for `size` strings, all null.
rcutils_ret_t rcutils_string_array_init(rcutils_string_array_t* array, size_t size,
                                        const rcutils_allocator_t* allocator);

// Frees every string and the array.
rcutils_ret_t rcutils_string_array_fini(rcutils_string_array_t* array);

// Frees the strings behind the new end, or makes room for more, all null.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_array_resize(rcutils_string_array_t* array, size_t new_size);

// The result is less than, equal to or more than 0. The first strings that differ decide, then the sizes.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_array_cmp(const rcutils_string_array_t* lhs,
                                                           const rcutils_string_array_t* rhs, int* res);

// By the bytes of the strings; null comes last.
RCUTILS_WARN_UNUSED int rcutils_string_array_sort_compare(const void* lhs, const void* rhs);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_string_array_sort(rcutils_string_array_t* array);

#ifdef __cplusplus
}
#endif
