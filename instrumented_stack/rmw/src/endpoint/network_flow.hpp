// SPDX-License-Identifier: Apache-2.0
// Converts locators of DDS to endpoints of network flows.
#pragma once

#include "fastdds_versions/guid.hpp"
#include "rmw/network_flow_endpoint.h"

namespace rmw_fastrtps {

// `endpoints` must be zero initialised. Returns RMW_RET_BAD_ALLOC if memory runs out.
rmw_ret_t to_endpoints(const eprosima::fastdds::rtps::LocatorList& locators, rcutils_allocator_t* allocator,
                       rmw_network_flow_endpoint_array_t& endpoints);

}  // namespace rmw_fastrtps
