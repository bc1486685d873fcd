// SPDX-License-Identifier: Apache-2.0
// A message as bytes: 4 bytes of encapsulation header, then CDR.
#pragma once

#include "rcutils/types/uint8_array.h"

typedef rcutils_uint8_array_t rmw_serialized_message_t;

#define rmw_get_zero_initialized_serialized_message rcutils_get_zero_initialized_uint8_array
#define rmw_serialized_message_init(msg, capacity, allocator) rcutils_uint8_array_init((msg), (capacity), (allocator))
#define rmw_serialized_message_fini(msg) rcutils_uint8_array_fini((msg))
#define rmw_serialized_message_resize(msg, new_size) rcutils_uint8_array_resize((msg), (new_size))
