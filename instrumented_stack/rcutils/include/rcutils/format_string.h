// SPDX-License-Identifier: Apache-2.0
// Formatted strings in memory from an allocator.
#pragma once

#include <stddef.h>

#include "rcutils/allocator.h"

#ifdef __cplusplus
extern "C" {
#endif

// At most `limit` characters, including the terminating zero. Null if the format is null, the allocator invalid, or
// memory runs out.
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
char* rcutils_format_string_limit(rcutils_allocator_t allocator, size_t limit, const char* format_string, ...);

#define rcutils_format_string(allocator, format_string, ...) \
  rcutils_format_string_limit(allocator, 2048, format_string, __VA_ARGS__)

#ifdef __cplusplus
}
#endif
