// SPDX-License-Identifier: Apache-2.0
// How far participants look for one another: RMW_AUTOMATIC_DISCOVERY_RANGE_… and static peers.
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <memory>

#include "participant/discovery_traffic.hpp"
#include "rmw/discovery_options.h"

namespace rmw_fastrtps {

// Transports that are chosen here let pass what `traffic` allows. Throws std::runtime_error if the name of a peer has
// no IPv4 address.
void configure_discovery(const rmw_discovery_options_t& options, std::uint32_t domain_id,
                         const std::shared_ptr<DiscoveryTraffic>& traffic,
                         eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace rmw_fastrtps
