// SPDX-License-Identifier: Apache-2.0
// The network address from which a publisher sends, or at which a subscription receives.
#pragma once

#include <rcl/network_flow_endpoints.h>
#include <rmw/network_flow_endpoint.h>

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace rclcpp {

class NetworkFlowEndpoint {
 public:
  explicit NetworkFlowEndpoint(const rmw_network_flow_endpoint_t& network_flow_endpoint);

  const std::string& transport_protocol() const { return transport_protocol_; }  // UDP, TCP or UNKNOWN
  const std::string& internet_protocol() const { return internet_protocol_; }    // IPv4, IPv6 or UNKNOWN
  uint16_t transport_port() const { return transport_port_; }
  uint32_t flow_label() const { return flow_label_; }
  uint8_t dscp() const { return dscp_; }
  const std::string& internet_address() const { return internet_address_; }

 private:
  std::string transport_protocol_;
  std::string internet_protocol_;
  uint16_t transport_port_;
  uint32_t flow_label_;
  uint8_t dscp_;
  std::string internet_address_;
};

bool operator==(const NetworkFlowEndpoint& left, const NetworkFlowEndpoint& right);
bool operator!=(const NetworkFlowEndpoint& left, const NetworkFlowEndpoint& right);
// Writes it as JSON.
std::ostream& operator<<(std::ostream& stream, const NetworkFlowEndpoint& network_flow_endpoint);

namespace detail {

// Returns the result of `get`, one of rmw's functions. Throws exceptions::RCLError.
std::vector<NetworkFlowEndpoint> network_flow_endpoints(
    const std::function<rmw_ret_t(rcutils_allocator_t*, rmw_network_flow_endpoint_array_t*)>& get);

}  // namespace detail

}  // namespace rclcpp
