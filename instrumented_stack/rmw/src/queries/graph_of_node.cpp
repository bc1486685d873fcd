// SPDX-License-Identifier: Apache-2.0
// Topics and services of one node.
#include <new>

#include "context/context_impl.hpp"
#include "queries/graph_names.hpp"
#include "rmw/error_handling.h"
#include "rmw/get_node_info_and_types.h"
#include "types/identifier.hpp"

namespace {

using rmw_fastrtps::GraphCache;

using ToRos = GraphCache::Topics (*)(const GraphCache::Topics&);

// The node's topics of a kind. `to_ros` selects and renames them; if it is null, all of them keep their DDS names.
rmw_ret_t names_of_node(const rmw_node_t* node, rcutils_allocator_t* allocator, const char* node_name,
                        const char* node_namespace, GraphCache::Kind kind, ToRos to_ros,
                        rmw_names_and_types_t* result) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_name, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_namespace, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(result, RMW_RET_INVALID_ARGUMENT);
  const auto topics = node->context->impl->graph.topics_of_node(node_namespace, node_name, kind);
  if (!topics) {
    RMW_SET_ERROR_MSG("cannot get the names of a node that is not known");
    return RMW_RET_NODE_NAME_NON_EXISTENT;
  }
  return rmw_fastrtps::hand_out(to_ros == nullptr ? *topics : to_ros(*topics), allocator, result);
} catch (const std::bad_alloc&) {
  RMW_SET_ERROR_MSG("out of memory for the names of a node");
  return RMW_RET_BAD_ALLOC;
}

// A service reads `rq/…Request` and writes `rr/…Reply`; a client does the opposite. So the topics that a node reads
// tell services from clients.
template <char kPrefix>
GraphCache::Topics services_with(const GraphCache::Topics& dds_topics) {
  GraphCache::Topics result;
  for (const auto& [topic, types] : dds_topics) {
    if (topic.size() > 1 && topic[0] == 'r' && topic[1] == kPrefix) {
      result.emplace(topic, types);
    }
  }
  return rmw_fastrtps::ros_services(result);
}

}  // namespace

rmw_ret_t rmw_get_publisher_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                    const char* node_name, const char* node_namespace, bool no_demangle,
                                                    rmw_names_and_types_t* topic_names_and_types) {
  return names_of_node(node, allocator, node_name, node_namespace, GraphCache::Kind::kWriter,
                       no_demangle ? nullptr : rmw_fastrtps::ros_topics, topic_names_and_types);
}

rmw_ret_t rmw_get_subscriber_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                     const char* node_name, const char* node_namespace,
                                                     bool no_demangle, rmw_names_and_types_t* topic_names_and_types) {
  return names_of_node(node, allocator, node_name, node_namespace, GraphCache::Kind::kReader,
                       no_demangle ? nullptr : rmw_fastrtps::ros_topics, topic_names_and_types);
}

rmw_ret_t rmw_get_service_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                  const char* node_name, const char* node_namespace,
                                                  rmw_names_and_types_t* service_names_and_types) {
  return names_of_node(node, allocator, node_name, node_namespace, GraphCache::Kind::kReader, services_with<'q'>,
                       service_names_and_types);
}

rmw_ret_t rmw_get_client_names_and_types_by_node(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                                 const char* node_name, const char* node_namespace,
                                                 rmw_names_and_types_t* service_names_and_types) {
  return names_of_node(node, allocator, node_name, node_namespace, GraphCache::Kind::kReader, services_with<'r'>,
                       service_names_and_types);
}
