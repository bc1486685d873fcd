// SPDX-License-Identifier: Apache-2.0
// Publishers and subscriptions of a topic.
#include "rmw/topic_endpoint_info.h"

#include <algorithm>
#include <new>

#include "context/context_impl.hpp"
#include "names/topic_name.hpp"
#include "queries/graph_names.hpp"
#include "rmw/error_handling.h"
#include "rmw/get_topic_endpoint_info.h"
#include "types/identifier.hpp"

namespace {

using rmw_fastrtps::GraphCache;

constexpr const char* kUnknownName = "_NODE_NAME_UNKNOWN_";
constexpr const char* kUnknownNamespace = "_NODE_NAMESPACE_UNKNOWN_";

rmw_topic_endpoint_info_t to_info(const GraphCache::OwnedEndpoint& owned, bool no_mangle,
                                  const rcutils_allocator_t& allocator) {
  const bool known = !owned.node_name.empty();
  const std::string& type = owned.endpoint.type;
  rmw_topic_endpoint_info_t info{};
  info.node_name = rmw_fastrtps::duplicate(known ? owned.node_name : kUnknownName, allocator);
  info.node_namespace = rmw_fastrtps::duplicate(known ? owned.node_namespace : kUnknownNamespace, allocator);
  info.topic_type = rmw_fastrtps::duplicate(no_mangle ? type : rmw_fastrtps::demangled_type(type), allocator);
  (void)rosidl_parse_type_hash_string(owned.endpoint.type_hash.c_str(), &info.topic_type_hash);
  info.endpoint_type =
      owned.endpoint.kind == GraphCache::Kind::kWriter ? RMW_ENDPOINT_PUBLISHER : RMW_ENDPOINT_SUBSCRIPTION;
  std::copy(owned.gid.begin(), owned.gid.end(), info.endpoint_gid);
  info.qos_profile = owned.endpoint.qos;
  return info;
}

rmw_ret_t infos(const rmw_node_t* node, rcutils_allocator_t* allocator, const char* topic_name, bool no_mangle,
                GraphCache::Kind kind, rmw_topic_endpoint_info_array_t* result) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(topic_name, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(result, RMW_RET_INVALID_ARGUMENT);
  if (result->info_array != nullptr) {
    RMW_SET_ERROR_MSG("the array of endpoints is not zero initialized");
    return RMW_RET_INVALID_ARGUMENT;
  }
  const auto endpoints =
      node->context->impl->graph.endpoints(kind, no_mangle ? topic_name : rmw_fastrtps::mangled_topic(topic_name));
  if (endpoints.empty()) {
    return RMW_RET_OK;
  }
  void* memory = allocator->zero_allocate(endpoints.size(), sizeof(rmw_topic_endpoint_info_t), allocator->state);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  result->info_array = static_cast<rmw_topic_endpoint_info_t*>(memory);
  for (const GraphCache::OwnedEndpoint& endpoint : endpoints) {
    result->info_array[result->size++] = to_info(endpoint, no_mangle, *allocator);
  }
  return RMW_RET_OK;
} catch (const std::bad_alloc&) {
  RMW_SET_ERROR_MSG("out of memory for the endpoints of a topic");
  return RMW_RET_BAD_ALLOC;
}

}  // namespace

rmw_topic_endpoint_info_array_t rmw_get_zero_initialized_topic_endpoint_info_array(void) {
  return {};
}

rmw_ret_t rmw_topic_endpoint_info_array_fini(rmw_topic_endpoint_info_array_t* array, rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  const auto release = [&](const void* memory) { allocator->deallocate(const_cast<void*>(memory), allocator->state); };
  for (size_t i = 0; i < array->size; ++i) {
    const rmw_topic_endpoint_info_t& info = array->info_array[i];
    release(info.node_name);
    release(info.node_namespace);
    release(info.topic_type);
  }
  release(array->info_array);
  *array = rmw_get_zero_initialized_topic_endpoint_info_array();
  return RMW_RET_OK;
}

rmw_ret_t rmw_get_publishers_info_by_topic(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                           const char* topic_name, bool no_mangle,
                                           rmw_topic_endpoint_info_array_t* info) {
  return infos(node, allocator, topic_name, no_mangle, GraphCache::Kind::kWriter, info);
}

rmw_ret_t rmw_get_subscriptions_info_by_topic(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                              const char* topic_name, bool no_mangle,
                                              rmw_topic_endpoint_info_array_t* info) {
  return infos(node, allocator, topic_name, no_mangle, GraphCache::Kind::kReader, info);
}
