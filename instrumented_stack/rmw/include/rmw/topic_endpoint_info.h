// SPDX-License-Identifier: Apache-2.0
// The known facts about one publisher or subscription of the system.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rcutils/allocator.h"
#include "rmw/types.h"
#include "rosidl_runtime_c/type_hash.h"

#ifdef __cplusplus
extern "C" {
#endif

// The strings are owned. An endpoint without a known node has name and namespace `_NODE_NAME_UNKNOWN_` and
// `_NODE_NAMESPACE_UNKNOWN_`. History and depth of an endpoint of another process are unknown, because discovery does
// not transmit them.
typedef struct rmw_topic_endpoint_info_s {
  const char* node_name;
  const char* node_namespace;
  const char* topic_type;
  rosidl_type_hash_t topic_type_hash;  // zero if the endpoint does not announce it
  rmw_endpoint_type_t endpoint_type;
  uint8_t endpoint_gid[RMW_GID_STORAGE_SIZE];
  rmw_qos_profile_t qos_profile;
} rmw_topic_endpoint_info_t;

typedef struct rmw_topic_endpoint_info_array_s {
  size_t size;
  rmw_topic_endpoint_info_t* info_array;
} rmw_topic_endpoint_info_array_t;

rmw_topic_endpoint_info_array_t rmw_get_zero_initialized_topic_endpoint_info_array(void);
// Also frees the strings. `allocator` is the one that was used to fill the array.
rmw_ret_t rmw_topic_endpoint_info_array_fini(rmw_topic_endpoint_info_array_t* array, rcutils_allocator_t* allocator);

#ifdef __cplusplus
}
#endif
