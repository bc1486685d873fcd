// SPDX-License-Identifier: Apache-2.0
#include "queries/graph_names.hpp"

#include <cstring>
#include <new>
#include <optional>
#include <string_view>

#include "names/topic_name.hpp"

namespace rmw_fastrtps {

namespace {

// The DDS topics that have a ROS name, by that name.
GraphCache::Topics ros_names(const GraphCache::Topics& dds_names,
                             std::optional<std::string> (*demangled_name)(std::string_view),
                             std::string (*demangled_type)(std::string_view)) {
  GraphCache::Topics result;
  for (const auto& [dds_topic, dds_types] : dds_names) {
    if (const auto name = demangled_name(dds_topic)) {
      for (const std::string& type : dds_types) {
        result[*name].insert(demangled_type(type));
      }
    }
  }
  return result;
}

}  // namespace

GraphCache::Topics ros_topics(const GraphCache::Topics& dds_topics) {
  return ros_names(dds_topics, demangled_topic, demangled_type);
}

GraphCache::Topics ros_services(const GraphCache::Topics& dds_topics) {
  return ros_names(dds_topics, demangled_service, demangled_service_type);
}

char* duplicate(const std::string& text, const rcutils_allocator_t& allocator) {
  char* copy = static_cast<char*>(allocator.allocate(text.size() + 1, allocator.state));
  if (copy == nullptr) {
    throw std::bad_alloc();
  }
  std::memcpy(copy, text.c_str(), text.size() + 1);
  return copy;
}

rmw_ret_t hand_out(const GraphCache::Topics& names, rcutils_allocator_t* allocator, rmw_names_and_types_t* result) {
  if (rmw_names_and_types_init(result, names.size(), allocator) != RMW_RET_OK) {
    return RMW_RET_ERROR;
  }
  std::size_t i = 0;
  for (const auto& [name, types] : names) {
    result->names.data[i] = duplicate(name, *allocator);
    if (rcutils_string_array_init(&result->types[i], types.size(), allocator) != RCUTILS_RET_OK) {
      return RMW_RET_BAD_ALLOC;
    }
    std::size_t k = 0;
    for (const std::string& type : types) {
      result->types[i].data[k++] = duplicate(type, *allocator);
    }
    ++i;
  }
  return RMW_RET_OK;
}

}  // namespace rmw_fastrtps
