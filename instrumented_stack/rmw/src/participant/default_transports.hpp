// SPDX-License-Identifier: Apache-2.0
// The transports of a participant whose profile names none: UDP and shared memory, as in Fast DDS.
#pragma once

#include <cstdint>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <memory>
#include <optional>

#include "participant/discovery_traffic.hpp"

namespace rmw_fastrtps {

// A reliable writer of Fast DDS asks all its readers for an acknowledgement whenever it has filled the send buffer of
// the transport, 104 KiB by default. Fast DDS 2.9 adds up these bytes wrongly where it sends from its own thread: it
// counts all that the process has ever sent, again with every message. So a process that has answered some dozens of
// others asks all of them after each announcement of an endpoint. With 50 processes that is most of what discovery
// does. With this size it is not felt in systems of several hundred processes, and writers of large histories are still
// acknowledged without waiting for their heartbeat.
constexpr std::uint32_t kBytesBetweenHeartbeats = 4 * 1024 * 1024;

// Fast DDS maps shared memory without making sure of its pages, and a page that gets none later ends the process by
// SIGBUS. True if the size of /dev/shm is not known.
bool has_room_in_shared_memory(std::uint64_t bytes);

// Whether the profile of the participant leaves the transports and the sizes of their buffers to Fast DDS.
bool has_default_transports(const eprosima::fastdds::dds::DomainParticipantQos& qos);

// What FASTDDS_BUILTIN_TRANSPORTS asks for, of the transports that this stack makes itself. Releases of Fast DDS that
// know the variable get the others, and those with options ("LARGE_DATA?max_msg_size=1MB").
struct BuiltinTransports {
  bool udp4 = true;
  bool udp6 = false;
  bool shared_memory = true;
  bool are_of_environment = false;
};

// Those of the variable, the default ones without it, or nothing if they are left to Fast DDS. A warning tells of a
// value that has no effect: one that is not known, or that this release of Fast DDS does not know.
std::optional<BuiltinTransports> wanted_builtin_transports();

// Warns if `qos` has no other transport than shared memory, and another user has the port by which the processes of the
// domain find each other: neither user hears the other then.
void warn_of_another_user(std::uint32_t domain_id, const eprosima::fastdds::dds::DomainParticipantQos& qos);

// `local_peers`: the number of participants on one host that a unicast announcement reaches; 0 for the default of Fast
// DDS. Buffers have the sizes of the profile. The transports report kBytesBetweenHeartbeats to writers, and let pass
// what `traffic` allows. Large messages have memory of their own (large_messages.hpp). Without room in /dev/shm, UDP is
// the only one, and a warning says so.
void use_default_transports(const BuiltinTransports& wanted, std::uint32_t local_peers,
                            const std::shared_ptr<DiscoveryTraffic>& traffic,
                            eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace rmw_fastrtps
