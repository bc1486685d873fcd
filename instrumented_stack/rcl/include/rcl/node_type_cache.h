// SPDX-License-Identifier: Apache-2.0
#ifndef RCL__NODE_TYPE_CACHE_H_
#define RCL__NODE_TYPE_CACHE_H_

#include "rcl/node.h"
#include "rosidl_runtime_c/type_description.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The types of the publishers, subscriptions, services, clients and actions that a node has at the time. These are the
/// types that it describes to others. All functions from any thread.

/// Counts one more user of the type. `description` may be null, for a type of which only the name is known: it is not
/// counted.
rcl_ret_t rcl_node_type_cache_register_type(const rcl_node_t* node, const rosidl_type_description_t* description);

/// Counts one user less. RCL_RET_ERROR if there was none.
rcl_ret_t rcl_node_type_cache_unregister_type(const rcl_node_t* node, const rosidl_type_description_t* description);

/// The type with this hash ("RIHS01_…"); null in `description` if the node has no user of it.
rcl_ret_t rcl_node_type_cache_get_type_info(const rcl_node_t* node, const char* type_hash,
                                            const rosidl_type_description_t** description);

#ifdef __cplusplus
}
#endif

#endif  // RCL__NODE_TYPE_CACHE_H_
