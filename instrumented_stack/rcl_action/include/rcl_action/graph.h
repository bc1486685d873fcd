// SPDX-License-Identifier: Apache-2.0
// The actions of the system. They are found by the topics and services that carry them.
#pragma once

#include "rcl/graph.h"
#include "rcl/node.h"

#ifdef __cplusplus
extern "C" {
#endif

// `action_names_and_types` must be zero initialised; finalize it with rcl_names_and_types_fini(). Names are full ones
// ("/fibonacci"), types look like "example_interfaces/action/Fibonacci". Actions that `node` has not discovered yet are
// missing.
rcl_ret_t rcl_action_get_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator,
                                         rcl_names_and_types_t* action_names_and_types);
// The actions of one node, as server or as client. Returns RCL_RET_NODE_NAME_NON_EXISTENT if no such node is known.
rcl_ret_t rcl_action_get_server_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                        const char* node_name, const char* node_namespace,
                                                        rcl_names_and_types_t* action_names_and_types);
rcl_ret_t rcl_action_get_client_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                        const char* node_name, const char* node_namespace,
                                                        rcl_names_and_types_t* action_names_and_types);

// How many clients or servers of the action there are, those of `node` included. `action_name` is a full name. One that
// nobody has is found 0 times.
rcl_ret_t rcl_action_count_clients(const rcl_node_t* node, const char* action_name, size_t* count);
rcl_ret_t rcl_action_count_servers(const rcl_node_t* node, const char* action_name, size_t* count);

#ifdef __cplusplus
}
#endif
