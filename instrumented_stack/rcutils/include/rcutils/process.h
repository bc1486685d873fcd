// SPDX-License-Identifier: Apache-2.0
// The current process.
#pragma once

#include "rcutils/allocator.h"

#ifdef __cplusplus
extern "C" {
#endif

int rcutils_get_pid(void);

// The name of the executable without its folder; null if memory runs out. The caller frees it with the allocator.
char* rcutils_get_executable_name(rcutils_allocator_t allocator);

#ifdef __cplusplus
}
#endif
