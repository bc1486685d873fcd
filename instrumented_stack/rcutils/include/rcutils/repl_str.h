// SPDX-License-Identifier: Apache-2.0
// Replacing a part of a string wherever it stands.
#pragma once

#include "rcutils/allocator.h"

#ifdef __cplusplus
extern "C" {
#endif

// A copy of the string, which the caller frees with the allocator. Null if memory runs out.
char* rcutils_repl_str(const char* str, const char* from, const char* to, const rcutils_allocator_t* allocator);

#ifdef __cplusplus
}
#endif
