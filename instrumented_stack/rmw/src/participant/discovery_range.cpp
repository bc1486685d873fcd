// SPDX-License-Identifier: Apache-2.0
#include "participant/discovery_range.hpp"

#include <optional>
#include <stdexcept>
#include <string>

#include "fastdds_versions/guid.hpp"
#include "participant/default_transports.hpp"

namespace rmw_fastrtps {
namespace {

// A unicast announcement reaches this many participants of one host.
constexpr std::uint32_t kLocalParticipants = 32;

rtps::Locator_t peer_locator(const std::string& host) {
  const auto addresses = rtps::IPLocator::resolveNameDNS(host);
  if (addresses.first.empty()) {
    throw std::runtime_error("discovery peer '" + host + "' has no IPv4 address");
  }
  rtps::Locator_t locator;
  rtps::IPLocator::setIPv4(locator, *addresses.first.begin());
  return locator;
}

void restrict_to_localhost(const std::optional<BuiltinTransports>& transports,
                           const std::shared_ptr<DiscoveryTraffic>& traffic, fdds::DomainParticipantQos& qos) {
  auto& builtin = qos.wire_protocol().builtin;
  // An explicit unicast locator keeps Fast DDS from listening to multicast.
  builtin.metatrafficMulticastLocatorList.clear();
  builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator_t());
  builtin.initialPeersList.push_back(peer_locator("127.0.0.1"));
  if (qos.transport().user_transports.empty() && transports) {
    // A peer without a port stands for the first participants of the host. By default that would be only four.
    use_default_transports(*transports, kLocalParticipants, traffic, qos);
  }
}

}  // namespace

void configure_discovery(const rmw_discovery_options_t& options, std::uint32_t domain_id,
                         const std::optional<BuiltinTransports>& transports,
                         const std::shared_ptr<DiscoveryTraffic>& traffic, fdds::DomainParticipantQos& qos) {
  auto& builtin = qos.wire_protocol().builtin;
  switch (options.automatic_discovery_range) {
    case RMW_AUTOMATIC_DISCOVERY_RANGE_OFF: {
      // There is room for this participant alone, whose own endpoints find each other.
      qos.allocation().participants.initial = 1;
      qos.allocation().participants.maximum = 1;
      qos.allocation().participants.increment = 0;
      builtin.metatrafficMulticastLocatorList.clear();
      builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator());
      return;
    }
    case RMW_AUTOMATIC_DISCOVERY_RANGE_LOCALHOST:
      restrict_to_localhost(transports, traffic, qos);
      break;
    case RMW_AUTOMATIC_DISCOVERY_RANGE_SYSTEM_DEFAULT:
      return;
    default:
      if (options.static_peers_count != 0 && builtin.initialPeersList.empty()) {
        // Explicit peers replace the multicast group to which Fast DDS announces by default.
        rtps::Locator_t multicast(qos.wire_protocol().port.getMulticastPort(domain_id));
        rtps::IPLocator::setIPv4(multicast, "239.255.0.1");
        builtin.initialPeersList.push_back(multicast);
      }
      break;
  }
  for (std::size_t i = 0; i < options.static_peers_count; ++i) {
    builtin.initialPeersList.push_back(peer_locator(options.static_peers[i]));
  }
}

}  // namespace rmw_fastrtps
