// SPDX-License-Identifier: Apache-2.0
// How far participants look for one another: RMW_AUTOMATIC_DISCOVERY_RANGE_… and static peers.
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <memory>
#include <optional>

#include "participant/default_transports.hpp"
#include "participant/discovery_traffic.hpp"
#include "rmw/discovery_options.h"

namespace rmw_fastrtps {

// `transports`: those that this stack makes, if the profile of the participant names none. If they are chosen here,
// they let pass what `traffic` allows. Throws std::runtime_error if the name of a peer has no IPv4 address.
void configure_discovery(const rmw_discovery_options_t& options, std::uint32_t domain_id,
                         const std::optional<BuiltinTransports>& transports,
                         const std::shared_ptr<DiscoveryTraffic>& traffic,
                         eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace rmw_fastrtps
