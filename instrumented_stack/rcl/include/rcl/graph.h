// The nodes, topics, services and endpoints that are known in the whole system.
#pragma once

#include "rcl/client.h"
#include "rcl/node.h"
#include "rcl/types.h"
#include "rcutils/types/string_array.h"
#include "rmw/names_and_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef rmw_names_and_types_t rcl_names_and_types_t;

#define rcl_get_zero_initialized_names_and_types rmw_get_zero_initialized_names_and_types

rcl_ret_t rcl_names_and_types_fini(rcl_names_and_types_t* names_and_types);

// Full topic name; no remapping is applied.
rcl_ret_t rcl_count_publishers(const rcl_node_t* node, const char* topic_name, size_t* count);
rcl_ret_t rcl_count_subscribers(const rcl_node_t* node, const char* topic_name, size_t* count);

// Names and namespaces of all nodes, in the same order. Free with rcutils_string_array_fini().
rcl_ret_t rcl_get_node_names(const rcl_node_t* node, rcl_allocator_t allocator, rcutils_string_array_t* node_names,
                             rcutils_string_array_t* node_namespaces);
rcl_ret_t rcl_get_topic_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator, bool no_demangle,
                                        rcl_names_and_types_t* topic_names_and_types);

// Full service name; no remapping is applied.
rcl_ret_t rcl_count_services(const rcl_node_t* node, const char* service_name, size_t* count);
rcl_ret_t rcl_count_clients(const rcl_node_t* node, const char* service_name, size_t* count);
rcl_ret_t rcl_get_service_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator,
                                          rcl_names_and_types_t* service_names_and_types);

// Whether a request of the client would be answered. Changes trigger the graph guard condition.
rcl_ret_t rcl_service_server_is_available(const rcl_node_t* node, const rcl_client_t* client, bool* is_available);

#ifdef __cplusplus
}
#endif
