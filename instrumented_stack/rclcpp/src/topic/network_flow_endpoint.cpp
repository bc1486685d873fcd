// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/network_flow_endpoint.hpp"

#include <rcl/network_flow_endpoints.h>

#include <tuple>

#include "rclcpp/detail/require_ok.hpp"

namespace rclcpp {

namespace {

std::string name_of(rmw_transport_protocol_t protocol) {
  switch (protocol) {
    case RMW_TRANSPORT_PROTOCOL_UDP:
      return "UDP";
    case RMW_TRANSPORT_PROTOCOL_TCP:
      return "TCP";
    case RMW_TRANSPORT_PROTOCOL_UNKNOWN:
      break;
  }
  return "UNKNOWN";
}

std::string name_of(rmw_internet_protocol_t protocol) {
  switch (protocol) {
    case RMW_INTERNET_PROTOCOL_IPV4:
      return "IPv4";
    case RMW_INTERNET_PROTOCOL_IPV6:
      return "IPv6";
    case RMW_INTERNET_PROTOCOL_UNKNOWN:
      break;
  }
  return "UNKNOWN";
}

auto as_tuple(const NetworkFlowEndpoint& endpoint) {
  return std::make_tuple(endpoint.transport_protocol(), endpoint.internet_protocol(), endpoint.transport_port(),
                         endpoint.flow_label(), endpoint.dscp(), endpoint.internet_address());
}

}  // namespace

NetworkFlowEndpoint::NetworkFlowEndpoint(const rmw_network_flow_endpoint_t& network_flow_endpoint)
    : transport_protocol_(name_of(network_flow_endpoint.transport_protocol)),
      internet_protocol_(name_of(network_flow_endpoint.internet_protocol)),
      transport_port_(network_flow_endpoint.transport_port),
      flow_label_(network_flow_endpoint.flow_label),
      dscp_(network_flow_endpoint.dscp),
      internet_address_(network_flow_endpoint.internet_address) {}

bool operator==(const NetworkFlowEndpoint& left, const NetworkFlowEndpoint& right) {
  return as_tuple(left) == as_tuple(right);
}

bool operator!=(const NetworkFlowEndpoint& left, const NetworkFlowEndpoint& right) {
  return !(left == right);
}

std::ostream& operator<<(std::ostream& stream, const NetworkFlowEndpoint& network_flow_endpoint) {
  return stream << "{\"transportProtocol\": \"" << network_flow_endpoint.transport_protocol()
                << "\", \"internetProtocol\": \"" << network_flow_endpoint.internet_protocol()
                << "\", \"transportPort\": \"" << network_flow_endpoint.transport_port() << "\", \"flowLabel\": \""
                << network_flow_endpoint.flow_label() << "\", \"dscp\": \"" << unsigned{network_flow_endpoint.dscp()}
                << "\", \"internetAddress\": \"" << network_flow_endpoint.internet_address() << "\"}";
}

namespace detail {

std::vector<NetworkFlowEndpoint> network_flow_endpoints(
    const std::function<rmw_ret_t(rcutils_allocator_t*, rmw_network_flow_endpoint_array_t*)>& get) {
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_network_flow_endpoint_array_t array = rmw_get_zero_initialized_network_flow_endpoint_array();
  detail::require_ok(get(&allocator, &array), "failed to get network flow endpoints");
  std::vector<NetworkFlowEndpoint> endpoints;
  for (size_t i = 0; i < array.size; ++i) {
    endpoints.emplace_back(array.network_flow_endpoint[i]);
  }
  (void)rcl_network_flow_endpoint_array_fini(&array);
  return endpoints;
}

}  // namespace detail

}  // namespace rclcpp
