// SPDX-License-Identifier: Apache-2.0
// The length of a string that may have no end.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// At most `maxlen`: no byte behind it is looked at.
size_t rcutils_strnlen(const char* s, size_t maxlen);

#ifdef __cplusplus
}
#endif
