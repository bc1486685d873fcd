// SPDX-License-Identifier: Apache-2.0
// How far participants look for one another: RMW_AUTOMATIC_DISCOVERY_RANGE_… and static peers.
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "rmw/discovery_options.h"

namespace rmw_fastrtps {

// Throws std::runtime_error if the name of a peer has no IPv4 address.
void configure_discovery(const rmw_discovery_options_t& options, std::uint32_t domain_id,
                         eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace rmw_fastrtps
