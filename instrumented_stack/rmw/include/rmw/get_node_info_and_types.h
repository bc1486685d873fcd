// SPDX-License-Identifier: Apache-2.0
// The topics and services of one node, which may be anywhere in the system.
#pragma once

#include "rmw/names_and_types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Returns RMW_RET_NODE_NAME_NON_EXISTENT if no such node is known. `no_demangle`: names and types as DDS has them.
rmw_ret_t rmw_get_publisher_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                    const char* node_name, const char* node_namespace, bool no_demangle,
                                                    rmw_names_and_types_t* topic_names_and_types);
rmw_ret_t rmw_get_subscriber_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                     const char* node_name, const char* node_namespace,
                                                     bool no_demangle, rmw_names_and_types_t* topic_names_and_types);
rmw_ret_t rmw_get_service_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                  const char* node_name, const char* node_namespace,
                                                  rmw_names_and_types_t* service_names_and_types);
rmw_ret_t rmw_get_client_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                 const char* node_name, const char* node_namespace,
                                                 rmw_names_and_types_t* service_names_and_types);

#ifdef __cplusplus
}
#endif
