// SPDX-License-Identifier: Apache-2.0
// The known nodes, topics, services and endpoints of the whole system.
#pragma once

#include "rcl/client.h"
#include "rcl/node.h"
#include "rcl/types.h"
#include "rcutils/types/string_array.h"
#include "rmw/names_and_types.h"
#include "rmw/service_endpoint_info_array.h"
#include "rmw/topic_endpoint_info.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef rmw_names_and_types_t rcl_names_and_types_t;
typedef rmw_topic_endpoint_info_t rcl_topic_endpoint_info_t;
typedef rmw_topic_endpoint_info_array_t rcl_topic_endpoint_info_array_t;
typedef rmw_service_endpoint_info_t rcl_service_endpoint_info_t;
typedef rmw_service_endpoint_info_array_t rcl_service_endpoint_info_array_t;

#define rcl_get_zero_initialized_names_and_types rmw_get_zero_initialized_names_and_types
#define rcl_get_zero_initialized_topic_endpoint_info_array rmw_get_zero_initialized_topic_endpoint_info_array
#define rcl_topic_endpoint_info_array_fini rmw_topic_endpoint_info_array_fini
#define rcl_get_zero_initialized_service_endpoint_info_array rmw_get_zero_initialized_service_endpoint_info_array
#define rcl_service_endpoint_info_array_fini rmw_service_endpoint_info_array_fini

rcl_ret_t rcl_names_and_types_fini(rcl_names_and_types_t* names_and_types);

// Takes the full topic name; no remapping is applied.
rcl_ret_t rcl_count_publishers(const rcl_node_t* node, const char* topic_name, size_t* count);
rcl_ret_t rcl_count_subscribers(const rcl_node_t* node, const char* topic_name, size_t* count);

// Names and namespaces of all nodes, in the same order. Free with rcutils_string_array_fini().
rcl_ret_t rcl_get_node_names(const rcl_node_t* node, rcl_allocator_t allocator, rcutils_string_array_t* node_names,
                             rcutils_string_array_t* node_namespaces);
// The same, and the enclave of each, "/" where it has none.
rcl_ret_t rcl_get_node_names_with_enclaves(const rcl_node_t* node, rcl_allocator_t allocator,
                                           rcutils_string_array_t* node_names, rcutils_string_array_t* node_namespaces,
                                           rcutils_string_array_t* enclaves);
rcl_ret_t rcl_get_topic_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator, bool no_demangle,
                                        rcl_names_and_types_t* topic_names_and_types);

// Takes the full service name; no remapping is applied.
rcl_ret_t rcl_count_services(const rcl_node_t* node, const char* service_name, size_t* count);
rcl_ret_t rcl_count_clients(const rcl_node_t* node, const char* service_name, size_t* count);
rcl_ret_t rcl_get_service_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator,
                                          rcl_names_and_types_t* service_names_and_types);

// The endpoints of one node. Returns RCL_RET_NODE_NAME_NON_EXISTENT if no such node is known.
rcl_ret_t rcl_get_publisher_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                    bool no_demangle, const char* node_name, const char* node_namespace,
                                                    rcl_names_and_types_t* topic_names_and_types);
rcl_ret_t rcl_get_subscriber_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                     bool no_demangle, const char* node_name,
                                                     const char* node_namespace,
                                                     rcl_names_and_types_t* topic_names_and_types);
rcl_ret_t rcl_get_service_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                  const char* node_name, const char* node_namespace,
                                                  rcl_names_and_types_t* service_names_and_types);
rcl_ret_t rcl_get_client_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                 const char* node_name, const char* node_namespace,
                                                 rcl_names_and_types_t* service_names_and_types);

// Takes the full topic name; with `no_mangle` the name is that of DDS. The array must be zero initialized.
rcl_ret_t rcl_get_publishers_info_by_topic(const rcl_node_t* node, rcl_allocator_t* allocator, const char* topic_name,
                                           bool no_mangle, rcl_topic_endpoint_info_array_t* publishers_info);
rcl_ret_t rcl_get_subscriptions_info_by_topic(const rcl_node_t* node, rcl_allocator_t* allocator,
                                              const char* topic_name, bool no_mangle,
                                              rcl_topic_endpoint_info_array_t* subscriptions_info);

// Takes the full name of the service; with `no_mangle` types are those of DDS. The array must be zero initialized.
rcl_ret_t rcl_get_clients_info_by_service(const rcl_node_t* node, rcl_allocator_t* allocator, const char* service_name,
                                          bool no_mangle, rcl_service_endpoint_info_array_t* clients_info);
rcl_ret_t rcl_get_servers_info_by_service(const rcl_node_t* node, rcl_allocator_t* allocator, const char* service_name,
                                          bool no_mangle, rcl_service_endpoint_info_array_t* servers_info);

// Wait until as many publishers or subscriptions of the full topic name are known, for at most `timeout` nanoseconds
// (negative: without limit). `success` tells whether they are. Return RCL_RET_TIMEOUT if they are not.
rcl_ret_t rcl_wait_for_publishers(const rcl_node_t* node, rcl_allocator_t* allocator, const char* topic_name,
                                  size_t expected_count, rcutils_duration_value_t timeout, bool* success);
rcl_ret_t rcl_wait_for_subscribers(const rcl_node_t* node, rcl_allocator_t* allocator, const char* topic_name,
                                   size_t expected_count, rcutils_duration_value_t timeout, bool* success);

// Whether a service would answer a request of the client. Changes trigger the graph guard condition.
rcl_ret_t rcl_service_server_is_available(const rcl_node_t* node, const rcl_client_t* client, bool* is_available);

#ifdef __cplusplus
}
#endif
