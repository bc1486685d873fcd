// SPDX-License-Identifier: Apache-2.0
// Clients and servers of a service: each is a reader and a writer of one node.
#include <algorithm>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "context/context_impl.hpp"
#include "names/topic_name.hpp"
#include "queries/graph_names.hpp"
#include "rmw/error_handling.h"
#include "rmw/get_service_endpoint_info.h"

namespace {

using rmw_fastrtps::GraphCache;
using Owned = GraphCache::OwnedEndpoint;

struct End {
  Owned reader;
  Owned writer;
};

// The bytes of a GID that all endpoints of a participant share.
constexpr std::size_t kGuidPrefixSize = 12;

bool are_of_one_node(const Owned& first, const Owned& second) {
  return std::equal(first.gid.begin(), first.gid.begin() + kGuidPrefixSize, second.gid.begin()) &&
         first.node_name == second.node_name && first.node_namespace == second.node_namespace;
}

// A participant numbers its endpoints in the order of their creation. So the first reader of a node belongs to its
// first writer, if it has several clients of one service. That does not hold while some of them are not discovered yet.
std::vector<Owned> in_order(std::vector<Owned> endpoints) {
  std::sort(endpoints.begin(), endpoints.end(),
            [](const Owned& first, const Owned& second) { return first.gid < second.gid; });
  return endpoints;
}

std::vector<End> ends(const GraphCache& graph, const std::string& topic_read, const std::string& topic_written) {
  std::vector<Owned> writers = in_order(graph.endpoints(GraphCache::Kind::kWriter, topic_written));
  std::vector<End> found;
  for (const Owned& reader : in_order(graph.endpoints(GraphCache::Kind::kReader, topic_read))) {
    const auto writer = std::find_if(writers.begin(), writers.end(),
                                     [&](const Owned& other) { return are_of_one_node(reader, other); });
    if (!reader.node_name.empty() && writer != writers.end()) {
      found.push_back({reader, *writer});
      writers.erase(writer);
    }
  }
  return found;
}

template <typename T>
T* allocate(std::size_t count, const rcutils_allocator_t& allocator) {
  void* memory = allocator.zero_allocate(count, sizeof(T), allocator.state);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return static_cast<T*>(memory);
}

void fill(rmw_service_endpoint_info_t& info, const End& end, rmw_endpoint_type_t type, bool no_mangle,
          const rcutils_allocator_t& allocator) {
  const std::string& dds_type = end.reader.endpoint.type;
  info.node_name = rmw_fastrtps::duplicate(end.reader.node_name, allocator);
  info.node_namespace = rmw_fastrtps::duplicate(end.reader.node_namespace, allocator);
  info.service_type =
      rmw_fastrtps::duplicate(no_mangle ? dds_type : rmw_fastrtps::demangled_service_type(dds_type), allocator);
  info.endpoint_type = type;
  info.endpoint_count = 2;
  info.endpoint_gids = allocate<std::uint8_t[RMW_GID_STORAGE_SIZE]>(info.endpoint_count, allocator);
  info.qos_profiles = allocate<rmw_qos_profile_t>(info.endpoint_count, allocator);
  std::size_t i = 0;
  for (const Owned* endpoint : {&end.reader, &end.writer}) {
    std::copy(endpoint->gid.begin(), endpoint->gid.end(), info.endpoint_gids[i]);
    info.qos_profiles[i++] = endpoint->endpoint.qos;
  }
}

rmw_ret_t infos(const rmw_node_t* node, rcutils_allocator_t* allocator, const char* service_name, bool no_mangle,
                rmw_endpoint_type_t type, rmw_service_endpoint_info_array_t* result) try {
  RMW_CHECK_HANDLE(node, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(service_name, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(result, RMW_RET_INVALID_ARGUMENT);
  if (result->info_array != nullptr) {
    RMW_SET_ERROR_MSG("the array of clients or servers is not zero initialized");
    return RMW_RET_INVALID_ARGUMENT;
  }
  const std::string requests = rmw_fastrtps::mangled_request_topic(service_name);
  const std::string responses = rmw_fastrtps::mangled_response_topic(service_name);
  const bool is_client = type == RMW_ENDPOINT_CLIENT;
  const std::vector<End> found =
      ends(node->context->impl->graph, is_client ? responses : requests, is_client ? requests : responses);
  if (found.empty()) {
    return RMW_RET_OK;
  }
  result->info_array = allocate<rmw_service_endpoint_info_t>(found.size(), *allocator);
  for (const End& end : found) {
    fill(result->info_array[result->size++], end, type, no_mangle, *allocator);
  }
  return RMW_RET_OK;
} catch (const std::bad_alloc&) {
  (void)rmw_service_endpoint_info_array_fini(result, allocator);
  RMW_SET_ERROR_MSG("out of memory for the clients or servers of a service");
  return RMW_RET_BAD_ALLOC;
}

}  // namespace

rmw_service_endpoint_info_t rmw_get_zero_initialized_service_endpoint_info(void) {
  return {};
}

rmw_ret_t rmw_service_endpoint_info_fini(rmw_service_endpoint_info_t* info, rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(info, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  const auto release = [&](const void* memory) { allocator->deallocate(const_cast<void*>(memory), allocator->state); };
  release(info->node_name);
  release(info->node_namespace);
  release(info->service_type);
  release(info->endpoint_gids);
  release(info->qos_profiles);
  *info = rmw_get_zero_initialized_service_endpoint_info();
  return RMW_RET_OK;
}

rmw_service_endpoint_info_array_t rmw_get_zero_initialized_service_endpoint_info_array(void) {
  return {};
}

rmw_ret_t rmw_service_endpoint_info_array_fini(rmw_service_endpoint_info_array_t* array,
                                               rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(array, RMW_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(allocator, RMW_RET_INVALID_ARGUMENT);
  for (size_t i = 0; i < array->size; ++i) {
    (void)rmw_service_endpoint_info_fini(&array->info_array[i], allocator);
  }
  allocator->deallocate(array->info_array, allocator->state);
  *array = rmw_get_zero_initialized_service_endpoint_info_array();
  return RMW_RET_OK;
}

rmw_ret_t rmw_get_clients_info_by_service(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                          const char* service_name, bool no_mangle,
                                          rmw_service_endpoint_info_array_t* info) {
  return infos(node, allocator, service_name, no_mangle, RMW_ENDPOINT_CLIENT, info);
}

rmw_ret_t rmw_get_servers_info_by_service(const rmw_node_t* node, rcutils_allocator_t* allocator,
                                          const char* service_name, bool no_mangle,
                                          rmw_service_endpoint_info_array_t* info) {
  return infos(node, allocator, service_name, no_mangle, RMW_ENDPOINT_SERVER, info);
}
