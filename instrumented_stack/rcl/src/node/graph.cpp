// SPDX-License-Identifier: Apache-2.0
#include "rcl/graph.h"

#include <chrono>

#include "rcl/error_handling.h"
#include "rmw/get_node_info_and_types.h"
#include "rmw/get_service_endpoint_info.h"
#include "rmw/get_topic_endpoint_info.h"
#include "rmw/rmw.h"
#include "rmw/wait_for_graph_change.h"

namespace {

// Asks rmw unless the node is invalid.
template <typename Ask, typename... Arguments>
rcl_ret_t ask(Ask of_rmw, const rcl_node_t* node, Arguments... arguments) {
  return rcl_node_is_valid(node) ? of_rmw(rcl_node_get_rmw_handle(node), arguments...) : RCL_RET_NODE_INVALID;
}

// As in ROS 2, no namespace is the root.
const char* namespace_of(const char* node_namespace) {
  return node_namespace != nullptr && *node_namespace == '\0' ? "/" : node_namespace;
}

using Count = rcl_ret_t (*)(const rcl_node_t*, const char*, size_t*);

rcl_ret_t wait_for(Count count, const rcl_node_t* node, const rcl_allocator_t* allocator, const char* topic_name,
                   size_t expected_count, rcutils_duration_value_t timeout, bool* success) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(success, RCL_RET_INVALID_ARGUMENT);
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  *success = false;
  const auto start = std::chrono::steady_clock::now();
  uint64_t changes = 0;
  (void)rmw_wait_for_graph_change(rcl_node_get_rmw_handle(node), &changes, 0);
  while (true) {
    size_t found = 0;
    if (const rcl_ret_t result = count(node, topic_name, &found); result != RCL_RET_OK) {
      return result;
    }
    if (found >= expected_count) {
      *success = true;
      return RCL_RET_OK;
    }
    rcutils_duration_value_t left = timeout;
    if (timeout >= 0) {
      const std::chrono::nanoseconds passed = std::chrono::steady_clock::now() - start;
      left = timeout > passed.count() ? timeout - passed.count() : 0;
    }
    if (left == 0 || !rcl_context_is_valid(node->context) ||
        rmw_wait_for_graph_change(rcl_node_get_rmw_handle(node), &changes, left) != RMW_RET_OK) {
      return RCL_RET_TIMEOUT;
    }
  }
}

}  // namespace

rcl_ret_t rcl_wait_for_publishers(const rcl_node_t* node, rcl_allocator_t* allocator, const char* topic_name,
                                  size_t expected_count, rcutils_duration_value_t timeout, bool* success) {
  return wait_for(rcl_count_publishers, node, allocator, topic_name, expected_count, timeout, success);
}

rcl_ret_t rcl_wait_for_subscribers(const rcl_node_t* node, rcl_allocator_t* allocator, const char* topic_name,
                                   size_t expected_count, rcutils_duration_value_t timeout, bool* success) {
  return wait_for(rcl_count_subscribers, node, allocator, topic_name, expected_count, timeout, success);
}

rcl_ret_t rcl_names_and_types_fini(rcl_names_and_types_t* names_and_types) {
  return rmw_names_and_types_fini(names_and_types);
}

rcl_ret_t rcl_count_publishers(const rcl_node_t* node, const char* topic_name, size_t* count) {
  return ask(rmw_count_publishers, node, topic_name, count);
}

rcl_ret_t rcl_count_subscribers(const rcl_node_t* node, const char* topic_name, size_t* count) {
  return ask(rmw_count_subscribers, node, topic_name, count);
}

rcl_ret_t rcl_get_node_names(const rcl_node_t* node, rcl_allocator_t, rcutils_string_array_t* node_names,
                             rcutils_string_array_t* node_namespaces) {
  return ask(rmw_get_node_names, node, node_names, node_namespaces);
}

rcl_ret_t rcl_get_node_names_with_enclaves(const rcl_node_t* node, rcl_allocator_t, rcutils_string_array_t* node_names,
                                           rcutils_string_array_t* node_namespaces, rcutils_string_array_t* enclaves) {
  return ask(rmw_get_node_names_with_enclaves, node, node_names, node_namespaces, enclaves);
}

rcl_ret_t rcl_get_topic_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator, bool no_demangle,
                                        rcl_names_and_types_t* topic_names_and_types) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RCL_RET_INVALID_ARGUMENT);
  return ask(rmw_get_topic_names_and_types, node, allocator, no_demangle, topic_names_and_types);
}

rcl_ret_t rcl_count_services(const rcl_node_t* node, const char* service_name, size_t* count) {
  return ask(rmw_count_services, node, service_name, count);
}

rcl_ret_t rcl_count_clients(const rcl_node_t* node, const char* service_name, size_t* count) {
  return ask(rmw_count_clients, node, service_name, count);
}

rcl_ret_t rcl_get_service_names_and_types(const rcl_node_t* node, rcl_allocator_t* allocator,
                                          rcl_names_and_types_t* service_names_and_types) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RCL_RET_INVALID_ARGUMENT);
  return ask(rmw_get_service_names_and_types, node, allocator, service_names_and_types);
}

rcl_ret_t rcl_get_publisher_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                    bool no_demangle, const char* node_name, const char* node_namespace,
                                                    rcl_names_and_types_t* topic_names_and_types) {
  return ask(rmw_get_publisher_names_and_types_by_node, node, allocator, node_name, namespace_of(node_namespace),
             no_demangle, topic_names_and_types);
}

rcl_ret_t rcl_get_subscriber_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                     bool no_demangle, const char* node_name,
                                                     const char* node_namespace,
                                                     rcl_names_and_types_t* topic_names_and_types) {
  return ask(rmw_get_subscriber_names_and_types_by_node, node, allocator, node_name, namespace_of(node_namespace),
             no_demangle, topic_names_and_types);
}

rcl_ret_t rcl_get_service_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                  const char* node_name, const char* node_namespace,
                                                  rcl_names_and_types_t* service_names_and_types) {
  return ask(rmw_get_service_names_and_types_by_node, node, allocator, node_name, namespace_of(node_namespace),
             service_names_and_types);
}

rcl_ret_t rcl_get_client_names_and_types_by_node(const rcl_node_t* node, rcl_allocator_t* allocator,
                                                 const char* node_name, const char* node_namespace,
                                                 rcl_names_and_types_t* service_names_and_types) {
  return ask(rmw_get_client_names_and_types_by_node, node, allocator, node_name, namespace_of(node_namespace),
             service_names_and_types);
}

rcl_ret_t rcl_get_publishers_info_by_topic(const rcl_node_t* node, rcl_allocator_t* allocator, const char* topic_name,
                                           bool no_mangle, rcl_topic_endpoint_info_array_t* publishers_info) {
  return ask(rmw_get_publishers_info_by_topic, node, allocator, topic_name, no_mangle, publishers_info);
}

rcl_ret_t rcl_get_subscriptions_info_by_topic(const rcl_node_t* node, rcl_allocator_t* allocator,
                                              const char* topic_name, bool no_mangle,
                                              rcl_topic_endpoint_info_array_t* subscriptions_info) {
  return ask(rmw_get_subscriptions_info_by_topic, node, allocator, topic_name, no_mangle, subscriptions_info);
}

rcl_ret_t rcl_get_clients_info_by_service(const rcl_node_t* node, rcl_allocator_t* allocator, const char* service_name,
                                          bool no_mangle, rcl_service_endpoint_info_array_t* clients_info) {
  return ask(rmw_get_clients_info_by_service, node, allocator, service_name, no_mangle, clients_info);
}

rcl_ret_t rcl_get_servers_info_by_service(const rcl_node_t* node, rcl_allocator_t* allocator, const char* service_name,
                                          bool no_mangle, rcl_service_endpoint_info_array_t* servers_info) {
  return ask(rmw_get_servers_info_by_service, node, allocator, service_name, no_mangle, servers_info);
}

rcl_ret_t rcl_service_server_is_available(const rcl_node_t* node, const rcl_client_t* client, bool* is_available) {
  if (!rcl_node_is_valid(node)) {
    return RCL_RET_NODE_INVALID;
  }
  if (!rcl_client_is_valid(client)) {
    return RCL_RET_CLIENT_INVALID;
  }
  return rmw_service_server_is_available(rcl_node_get_rmw_handle(node), rcl_client_get_rmw_handle(client),
                                         is_available);
}
