// SPDX-License-Identifier: Apache-2.0
// A byte buffer with its own allocator: the storage of serialized messages.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcutils_uint8_array_s {
  uint8_t* buffer;
  size_t buffer_length;    // bytes in use
  size_t buffer_capacity;  // bytes allocated
  rcutils_allocator_t allocator;
} rcutils_uint8_array_t;

rcutils_uint8_array_t rcutils_get_zero_initialized_uint8_array(void);

// Allocates `capacity` bytes (may be 0); the length stays 0.
rcutils_ret_t rcutils_uint8_array_init(rcutils_uint8_array_t* array, size_t capacity,
                                       const rcutils_allocator_t* allocator);

rcutils_ret_t rcutils_uint8_array_fini(rcutils_uint8_array_t* array);

// Changes the capacity. A longer length is cut to it. `new_size` must not be 0.
rcutils_ret_t rcutils_uint8_array_resize(rcutils_uint8_array_t* array, size_t new_size);

#ifdef __cplusplus
}
#endif
