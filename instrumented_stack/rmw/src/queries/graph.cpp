// SPDX-License-Identifier: Apache-2.0
// Answers questions about the graph from the cache.
#include <new>
#include <string>
#include <string_view>

#include "context/context_impl.hpp"
#include "names/topic_name.hpp"
#include "queries/graph_names.hpp"
#include "rmw/error_handling.h"
#include "rmw/rmw.h"
#include "rmw/wait_for_graph_change.h"
#include "types/identifier.hpp"

using rmw_fastrtps::duplicate;
using rmw_fastrtps::GraphCache;
using rmw_fastrtps::hand_out;

namespace {

rmw_ret_t count(const rmw_node_t* node, const char* name, std::string (*mangled)(std::string_view),
                GraphCache::Kind kind, size_t* result) {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(name, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(result, RMW_RET_INVALID_ARGUMENT);
  *result = node->context->impl->graph.count(kind, mangled(name));
  return RMW_RET_OK;
}

// Fills one array with a member of every node.
void fill(rcutils_string_array_t* array, const std::vector<GraphCache::Node>& nodes,
          std::string GraphCache::Node::*text) {
  if (array == nullptr) {
    return;
  }
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  if (rcutils_string_array_init(array, nodes.size(), &allocator) != RCUTILS_RET_OK) {
    throw std::bad_alloc();
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    array->data[i] = duplicate(nodes[i].*text, allocator);
  }
}

}  // namespace

rmw_ret_t rmw_get_node_names(const rmw_node_t* node, rcutils_string_array_t* node_names,
                             rcutils_string_array_t* node_namespaces) {
  rcutils_string_array_t enclaves = rcutils_get_zero_initialized_string_array();
  const rmw_ret_t result = rmw_get_node_names_with_enclaves(node, node_names, node_namespaces, &enclaves);
  (void)rcutils_string_array_fini(&enclaves);
  return result;
}

rmw_ret_t rmw_get_node_names_with_enclaves(const rmw_node_t* node, rcutils_string_array_t* node_names,
                                           rcutils_string_array_t* node_namespaces,
                                           rcutils_string_array_t* enclaves) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  const auto nodes = node->context->impl->graph.nodes();
  fill(node_names, nodes, &GraphCache::Node::name);
  fill(node_namespaces, nodes, &GraphCache::Node::namespace_);
  fill(enclaves, nodes, &GraphCache::Node::enclave);
  return RMW_RET_OK;
} catch (const std::bad_alloc&) {
  RMW_SET_ERROR_MSG("out of memory for the names of nodes");
  return RMW_RET_BAD_ALLOC;
}

rmw_ret_t rmw_count_publishers(const rmw_node_t* node, const char* topic_name, size_t* result) {
  return count(node, topic_name, rmw_fastrtps::mangled_topic, GraphCache::Kind::kWriter, result);
}

rmw_ret_t rmw_count_subscribers(const rmw_node_t* node, const char* topic_name, size_t* result) {
  return count(node, topic_name, rmw_fastrtps::mangled_topic, GraphCache::Kind::kReader, result);
}

rmw_ret_t rmw_get_topic_names_and_types(const rmw_node_t* node, rcutils_allocator_t* allocator, bool no_demangle,
                                        rmw_names_and_types_t* topic_names_and_types) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_names_and_types, RMW_RET_INVALID_ARGUMENT);
  const auto topics = node->context->impl->graph.topics();
  return hand_out(no_demangle ? topics : rmw_fastrtps::ros_topics(topics), allocator, topic_names_and_types);
} catch (const std::bad_alloc&) {
  RMW_SET_ERROR_MSG("out of memory for the names of topics");
  return RMW_RET_BAD_ALLOC;
}

rmw_ret_t rmw_get_service_names_and_types(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                          rmw_names_and_types_t* service_names_and_types) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service_names_and_types, RMW_RET_INVALID_ARGUMENT);
  return hand_out(rmw_fastrtps::ros_services(node->context->impl->graph.topics()), allocator, service_names_and_types);
} catch (const std::bad_alloc&) {
  RMW_SET_ERROR_MSG("out of memory for the names of services");
  return RMW_RET_BAD_ALLOC;
}

// Clients write to the topic that services read.
rmw_ret_t rmw_count_services(const rmw_node_t* node, const char* service_name, size_t* result) {
  return count(node, service_name, rmw_fastrtps::mangled_request_topic, GraphCache::Kind::kReader, result);
}

rmw_ret_t rmw_count_clients(const rmw_node_t* node, const char* service_name, size_t* result) {
  return count(node, service_name, rmw_fastrtps::mangled_request_topic, GraphCache::Kind::kWriter, result);
}

rmw_ret_t rmw_wait_for_graph_change(const rmw_node_t* node, uint64_t* number, rmw_duration_t timeout) {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(number, RMW_RET_INVALID_ARGUMENT);
  const bool changed = node->context->impl->graph_changes.wait(*number, std::chrono::nanoseconds(timeout));
  return changed ? RMW_RET_OK : RMW_RET_TIMEOUT;
}
