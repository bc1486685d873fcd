// SPDX-License-Identifier: Apache-2.0
// Ports in shared memory that no process has had before.
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

namespace rmw_fastrtps {

// Gives a participant random ports in shared memory, where `qos` leaves the choice to Fast DDS. Everything else stays
// as Fast DDS chooses it; the UDP ports are the well-known ones. `prefix` is that of any participant of this host.
//
// Fast DDS numbers the ports of shared memory like those of UDP, so a process in the place of one that was killed has
// the same. It unlinks what its predecessor has left and makes the ports anew, but release 2.9 does not tell those who
// have the old memory mapped (its pull request 4728 does): they go on writing there until a watchdog finds that nobody
// reads. Discovery took 3 to 5 s that way, and messages of best effort were lost.
void choose_shared_memory_ports(std::uint32_t domain_id, const eprosima::fastrtps::rtps::GuidPrefix_t& prefix,
                                eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace rmw_fastrtps
