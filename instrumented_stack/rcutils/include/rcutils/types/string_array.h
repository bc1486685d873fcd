// SPDX-License-Identifier: Apache-2.0
// An owned array of C strings.
#pragma once

#include <stddef.h>

#include "rcutils/allocator.h"
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

#ifdef __cplusplus
}
#endif
