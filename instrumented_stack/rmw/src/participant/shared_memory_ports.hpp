// SPDX-License-Identifier: Apache-2.0
// Ports in shared memory that no earlier process used.
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "fastdds_versions/guid.hpp"

namespace rmw_fastrtps {

// Gives a participant random ports in shared memory if `qos` leaves the choice to Fast DDS. Fast DDS chooses the rest
// as usual, and the UDP ports are the well-known ports. `prefix` is the prefix of any participant of this host.
//
// Fast DDS numbers shared memory ports like UDP ports. So a process that replaces a killed one gets the same ports. It
// unlinks its predecessor's ports and makes new ones. But release 2.9 does not tell processes that have the old memory
// mapped (its pull request 4728 does). They go on writing there until a watchdog finds that no process reads. This
// delayed discovery by 3 to 5 s and lost best-effort messages.
void choose_shared_memory_ports(std::uint32_t domain_id, const rtps::GuidPrefix_t& prefix,
                                eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace rmw_fastrtps
