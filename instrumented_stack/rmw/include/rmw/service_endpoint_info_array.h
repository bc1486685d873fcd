// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rmw/service_endpoint_info.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_service_endpoint_info_array_s {
  size_t size;
  rmw_service_endpoint_info_t* info_array;
} rmw_service_endpoint_info_array_t;

rmw_service_endpoint_info_array_t rmw_get_zero_initialized_service_endpoint_info_array(void);
// Also ends its elements. `allocator` is the one that was used to fill the array.
rmw_ret_t rmw_service_endpoint_info_array_fini(rmw_service_endpoint_info_array_t* array,
                                               rcutils_allocator_t* allocator);

#ifdef __cplusplus
}
#endif
