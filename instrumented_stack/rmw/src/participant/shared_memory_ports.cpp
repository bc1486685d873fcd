// SPDX-License-Identifier: Apache-2.0
#include "participant/shared_memory_ports.hpp"

#include <random>

#include "fastdds_versions/guid.hpp"

namespace rmw_fastrtps {
namespace {

enum class Kind : rtps::octet { kUnicast = 'U', kMulticast = 'M' };

// Fast DDS writes these locators like this: the kind, then the two bytes of the host that are also in GUIDs.
rtps::Locator_t shared_memory(Kind kind, std::uint32_t port, const rtps::GuidPrefix_t& prefix) {
  rtps::Locator_t locator(LOCATOR_KIND_SHM, port);
  locator.address[0] = static_cast<rtps::octet>(kind);
  locator.address[1] = prefix.value[2];
  locator.address[2] = prefix.value[3];
  return locator;
}

// Higher than all UDP ports, because other processes use those numbers in shared memory, too.
std::uint32_t random_port() {
  std::random_device random;
  return std::uniform_int_distribution<std::uint32_t>(0x10000, 0x7fffffff)(random);
}

}  // namespace

void choose_shared_memory_ports(std::uint32_t domain_id, const rtps::GuidPrefix_t& prefix,
                                fdds::DomainParticipantQos& qos) {
  const rtps::Locator_t udp;  // any network; Fast DDS finds the port
  auto& wire = qos.wire_protocol();
  auto& builtin = wire.builtin;
  if (builtin.metatrafficUnicastLocatorList.empty() && builtin.metatrafficMulticastLocatorList.empty()) {
    builtin.metatrafficUnicastLocatorList.push_back(udp);
    builtin.metatrafficUnicastLocatorList.push_back(shared_memory(Kind::kUnicast, random_port(), prefix));
    const std::uint32_t multicast_port = wire.port.getMulticastPort(domain_id);
    rtps::Locator_t udp_multicast(multicast_port);
    rtps::IPLocator::setIPv4(udp_multicast, "239.255.0.1");
    builtin.metatrafficMulticastLocatorList.push_back(udp_multicast);
    builtin.metatrafficMulticastLocatorList.push_back(shared_memory(Kind::kMulticast, multicast_port, prefix));
  }
  if (wire.default_unicast_locator_list.empty() && wire.default_multicast_locator_list.empty()) {
    wire.default_unicast_locator_list.push_back(udp);
    wire.default_unicast_locator_list.push_back(shared_memory(Kind::kUnicast, random_port(), prefix));
  }
}

}  // namespace rmw_fastrtps
