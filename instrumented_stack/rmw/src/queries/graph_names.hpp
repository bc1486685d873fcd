// SPDX-License-Identifier: Apache-2.0
// Converts names of the graph from DDS to ROS, and into C structures for the caller.
#pragma once

#include <string>

#include "graph/graph_cache.hpp"
#include "rcutils/allocator.h"
#include "rmw/names_and_types.h"

namespace rmw_fastrtps {

// The DDS topics that are ROS topics or belong to services, with their ROS names and types.
GraphCache::Topics ros_topics(const GraphCache::Topics& dds_topics);
GraphCache::Topics ros_services(const GraphCache::Topics& dds_topics);

// Throw std::bad_alloc.
char* duplicate(const std::string& text, const rcutils_allocator_t& allocator);
rmw_ret_t hand_out(const GraphCache::Topics& names, rcutils_allocator_t* allocator, rmw_names_and_types_t* result);

}  // namespace rmw_fastrtps
