// SPDX-License-Identifier: Apache-2.0
// Copies of strings in memory from an allocator; to be given back to it.
#pragma once

#include <stddef.h>

#include "rcutils/allocator.h"

#ifdef __cplusplus
extern "C" {
#endif

// Null for a null string, an invalid allocator, or without memory.
char* rcutils_strdup(const char* str, rcutils_allocator_t allocator);
// At most `string_length` characters.
char* rcutils_strndup(const char* str, size_t string_length, rcutils_allocator_t allocator);

#ifdef __cplusplus
}
#endif
