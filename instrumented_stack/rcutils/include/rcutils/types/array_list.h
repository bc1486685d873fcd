// SPDX-License-Identifier: Apache-2.0
// A list of elements of one size, which it copies.
//
// RCUTILS_RET_INVALID_ARGUMENT: an argument is null, or an index behind the end. RCUTILS_RET_NOT_INITIALIZED: the list
// was not initialized.
#pragma once

#include <stddef.h>
#include <string.h>

#include "rcutils/allocator.h"
#include "rcutils/error_handling.h"
#include "rcutils/macros.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

struct rcutils_array_list_impl_s;

typedef struct rcutils_array_list_s {
  struct rcutils_array_list_impl_s* impl;
} rcutils_array_list_t;

#define ARRAY_LIST_VALIDATE_ARRAY_LIST(array_list)                           \
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array_list, RCUTILS_RET_INVALID_ARGUMENT); \
  if ((array_list)->impl == NULL) {                                          \
    RCUTILS_SET_ERROR_MSG("array_list is not initialized");                  \
    return RCUTILS_RET_NOT_INITIALIZED;                                      \
  }

rcutils_array_list_t rcutils_get_zero_initialized_array_list(void);

// Neither the capacity nor the size of an element may be 0.
rcutils_ret_t rcutils_array_list_init(rcutils_array_list_t* array_list, size_t initial_capacity, size_t data_size,
                                      const rcutils_allocator_t* allocator);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_array_list_fini(rcutils_array_list_t* array_list);

// Copies an element from `data` to the end or to a place, or from a place to `data`.
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_array_list_add(rcutils_array_list_t* array_list, const void* data);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_array_list_set(rcutils_array_list_t* array_list, size_t index,
                                                         const void* data);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_array_list_get(const rcutils_array_list_t* array_list, size_t index,
                                                         void* data);

RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_array_list_remove(rcutils_array_list_t* array_list, size_t index);
RCUTILS_WARN_UNUSED rcutils_ret_t rcutils_array_list_get_size(const rcutils_array_list_t* array_list, size_t* size);

#ifdef __cplusplus
}
#endif
