// SPDX-License-Identifier: Apache-2.0
#include "endpoint/network_flow.hpp"

#include <cstring>
#include <string>

#include "fastdds_versions/guid.hpp"
#include "rmw/error_handling.h"

namespace rmw_fastrtps {
namespace {

using rtps::IPLocator;
using rtps::Locator_t;

rmw_network_flow_endpoint_t to_endpoint(const Locator_t& locator) {
  rmw_network_flow_endpoint_t endpoint{};
  const bool is_udp = locator.kind == LOCATOR_KIND_UDPv4 || locator.kind == LOCATOR_KIND_UDPv6;
  const bool is_tcp = locator.kind == LOCATOR_KIND_TCPv4 || locator.kind == LOCATOR_KIND_TCPv6;
  if (!is_udp && !is_tcp) {
    return endpoint;
  }
  const bool is_ipv4 = locator.kind == LOCATOR_KIND_UDPv4 || locator.kind == LOCATOR_KIND_TCPv4;
  endpoint.transport_protocol = is_udp ? RMW_TRANSPORT_PROTOCOL_UDP : RMW_TRANSPORT_PROTOCOL_TCP;
  endpoint.internet_protocol = is_ipv4 ? RMW_INTERNET_PROTOCOL_IPV4 : RMW_INTERNET_PROTOCOL_IPV6;
  endpoint.transport_port = IPLocator::getPhysicalPort(locator);
  const std::string address = is_ipv4 ? IPLocator::toIPv4string(locator) : IPLocator::toIPv6string(locator);
  std::strncpy(endpoint.internet_address, address.c_str(), sizeof(endpoint.internet_address) - 1);
  return endpoint;
}

}  // namespace

rmw_ret_t to_endpoints(const eprosima::fastdds::rtps::LocatorList& locators, rcutils_allocator_t* allocator,
                       rmw_network_flow_endpoint_array_t& endpoints) {
  size_t count = 0;
  for (auto it = locators.begin(); it != locators.end(); ++it) {
    ++count;
  }
  endpoints.allocator = allocator;
  if (count == 0) {
    return RMW_RET_OK;
  }
  endpoints.network_flow_endpoint = static_cast<rmw_network_flow_endpoint_t*>(
      allocator->allocate(count * sizeof(rmw_network_flow_endpoint_t), allocator->state));
  if (endpoints.network_flow_endpoint == nullptr) {
    RMW_SET_ERROR_MSG("no memory for network flow endpoints");
    return RMW_RET_BAD_ALLOC;
  }
  for (const Locator_t& locator : locators) {
    endpoints.network_flow_endpoint[endpoints.size++] = to_endpoint(locator);
  }
  return RMW_RET_OK;
}

}  // namespace rmw_fastrtps

rmw_network_flow_endpoint_array_t rmw_get_zero_initialized_network_flow_endpoint_array(void) {
  return {};
}

rmw_ret_t rmw_network_flow_endpoint_array_fini(rmw_network_flow_endpoint_array_t* network_flow_endpoint_array) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(network_flow_endpoint_array, RMW_RET_INVALID_ARGUMENT);
  if (network_flow_endpoint_array->network_flow_endpoint != nullptr) {
    rcutils_allocator_t* allocator = network_flow_endpoint_array->allocator;
    allocator->deallocate(network_flow_endpoint_array->network_flow_endpoint, allocator->state);
  }
  *network_flow_endpoint_array = rmw_get_zero_initialized_network_flow_endpoint_array();
  return RMW_RET_OK;
}
