// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rcl/node.h"
#include "rosidl_runtime_c/type_description.h"

#ifdef __cplusplus
extern "C" {
#endif

// The types of the current publishers, subscriptions, services, clients and actions of a node. The node describes
// these types to others. All functions may be called from any thread.

// Counts one more user of the type. `description` may be null if only the name of the type is known. Then the call has
// no effect.
rcl_ret_t rcl_node_type_cache_register_type(const rcl_node_t* node, const rosidl_type_description_t* description);

// Counts one user less. Returns RCL_RET_ERROR if there was none.
rcl_ret_t rcl_node_type_cache_unregister_type(const rcl_node_t* node, const rosidl_type_description_t* description);

// Finds the type with this hash ("RIHS01_…"). `description` becomes null if the node has no user of it.
rcl_ret_t rcl_node_type_cache_get_type_info(const rcl_node_t* node, const char* type_hash,
                                            const rosidl_type_description_t** description);

#ifdef __cplusplus
}
#endif
