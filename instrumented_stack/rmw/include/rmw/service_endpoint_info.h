// SPDX-License-Identifier: Apache-2.0
// The known facts about one client or one server of a service.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rmw/types.h"
#include "rosidl_runtime_c/type_hash.h"

#ifdef __cplusplus
extern "C" {
#endif

// The strings and arrays are owned. A client or server has two endpoints here, its reader and its writer, in this
// order. Of another process, history and depth are unknown, because discovery does not transmit them.
typedef struct rmw_service_endpoint_info_s {
  const char* node_name;
  const char* node_namespace;
  const char* service_type;
  rosidl_type_hash_t service_type_hash;  // zero: endpoints announce the hashes of request and response only
  rmw_endpoint_type_t endpoint_type;     // RMW_ENDPOINT_CLIENT or RMW_ENDPOINT_SERVER
  size_t endpoint_count;
  uint8_t (*endpoint_gids)[RMW_GID_STORAGE_SIZE];
  rmw_qos_profile_t* qos_profiles;
} rmw_service_endpoint_info_t;

rmw_service_endpoint_info_t rmw_get_zero_initialized_service_endpoint_info(void);
// `allocator` is the one that was used to fill it.
rmw_ret_t rmw_service_endpoint_info_fini(rmw_service_endpoint_info_t* info, rcutils_allocator_t* allocator);

#ifdef __cplusplus
}
#endif
