// SPDX-License-Identifier: Apache-2.0
// Copies of strings in memory from an allocator, which must also free them.
#pragma once

#include <stddef.h>

#include "rcutils/allocator.h"

#ifdef __cplusplus
extern "C" {
#endif

// Null if the string is null, the allocator invalid, or memory runs out.
char* rcutils_strdup(const char* str, rcutils_allocator_t allocator);
// Copies at most `string_length` characters.
char* rcutils_strndup(const char* str, size_t string_length, rcutils_allocator_t allocator);

#ifdef __cplusplus
}
#endif
