// SPDX-License-Identifier: Apache-2.0
// Finding a character in a string.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The place of the first or the last `delimiter`, SIZE_MAX if there is none or the string is null.
size_t rcutils_find(const char* str, char delimiter);
size_t rcutils_findn(const char* str, char delimiter, size_t string_length);
size_t rcutils_find_last(const char* str, char delimiter);
size_t rcutils_find_lastn(const char* str, char delimiter, size_t string_length);

#ifdef __cplusplus
}
#endif
