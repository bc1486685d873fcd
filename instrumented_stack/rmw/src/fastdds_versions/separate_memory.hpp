// SPDX-License-Identifier: Apache-2.0
// Keeps processes of different releases of Fast DDS out of each other's shared memory.
//
// Release 2.9.1, which Debian 12 has, lays out its ports like no other one: their condition variables are 16 bytes
// longer. Yet all releases of version 2 give their ports the same names, and every process opens the port of its
// domain's multicast. So 2.9.1 and another release 2 on one host, such as those of ROS 2, read each other's memory
// wrongly, and mostly one of them aborts at once (a failed assertion in Boost).
//
// With 2.9.1 the ports of this stack therefore have other numbers than their locators say. And the locators that it
// announces name another host, in a way that the processes of this stack alone understand: for all others this process
// is on another host as far as shared memory is concerned, and the other way round, so that UDP is between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fastdds_versions/names.hpp"

#if RMW_FASTDDS_MAJOR >= 3
#include <fastdds/rtps/transport/TransportInterface.hpp>
#else
#include <fastdds/rtps/transport/TransportInterface.h>
#endif

#if RMW_FASTDDS_MAJOR == 2 && RMW_FASTDDS_MINOR == 9 && FASTRTPS_VERSION_MICRO == 1
#define RMW_FASTDDS_HAS_MEMORY_OF_ITS_OWN 1
#else
#define RMW_FASTDDS_HAS_MEMORY_OF_ITS_OWN 0
#endif

namespace rmw_fastrtps {

// The number in the name of the file of a locator's port.
constexpr std::uint32_t shared_memory_file_number(std::uint32_t port) {
  return RMW_FASTDDS_HAS_MEMORY_OF_ITS_OWN ? port | 0x80000000U : port;
}

// Where the two bytes of the host are in each locator of shared memory that a message announces for a participant or an
// endpoint: places in `message`, which has an RTPS header.
std::vector<std::size_t> announced_hosts(std::span<const std::uint8_t> message);

// Puts before a transport what separates its memory, if this release needs it.
std::unique_ptr<rtps::TransportInterface> with_separate_memory(std::unique_ptr<rtps::TransportInterface> transport);

}  // namespace rmw_fastrtps
