// SPDX-License-Identifier: Apache-2.0
// Dividing a string at a character.
#pragma once

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/types/string_array.h"

#ifdef __cplusplus
extern "C" {
#endif

// The parts between delimiters. A delimiter at either end makes no empty part. An empty or null string has no parts.
// End the array with rcutils_string_array_fini().
rcutils_ret_t rcutils_split(const char* str, char delimiter, rcutils_allocator_t allocator,
                            rcutils_string_array_t* string_array);
// The same, divided at the last delimiter only.
rcutils_ret_t rcutils_split_last(const char* str, char delimiter, rcutils_allocator_t allocator,
                                 rcutils_string_array_t* string_array);

#ifdef __cplusplus
}
#endif
