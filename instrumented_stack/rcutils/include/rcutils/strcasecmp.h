// SPDX-License-Identifier: Apache-2.0
// Comparing strings without regard to case.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Sets *value to what strcasecmp() returns. Returns 0, or EINVAL for null.
int rcutils_strcasecmp(const char* s1, const char* s2, int* value);
// Compares at most `n` characters.
int rcutils_strncasecmp(const char* s1, const char* s2, size_t n, int* value);

#ifdef __cplusplus
}
#endif
