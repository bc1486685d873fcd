// SPDX-License-Identifier: Apache-2.0
// snprintf that can also return only the length.
#pragma once

#include <stdarg.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Like snprintf. With a null buffer of size 0 it returns the number of characters needed. Returns -1 with EINVAL for a
// null format, or for a null buffer of another size.
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
int rcutils_snprintf(char* buffer, size_t buffer_size, const char* format, ...);

#if defined(__GNUC__)
__attribute__((format(printf, 3, 0)))
#endif
int rcutils_vsnprintf(char* buffer, size_t buffer_size, const char* format, va_list args);

#ifdef __cplusplus
}
#endif
