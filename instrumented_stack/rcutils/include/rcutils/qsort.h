// SPDX-License-Identifier: Apache-2.0
// Sorting an array in place.
#pragma once

#include <stddef.h>

#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

// As qsort(); returns RCUTILS_RET_INVALID_ARGUMENT for a null array that has elements, and without a comparison.
rcutils_ret_t rcutils_qsort(void* ptr, size_t count, size_t size, int (*comp)(const void*, const void*));

#ifdef __cplusplus
}
#endif
