// SPDX-License-Identifier: Apache-2.0
// Whether the shared memory of this release of Fast DDS is laid out like that of others.
//
// Release 2.9.1, which Debian 12 has, lays out its ports like no other one: their condition variables are 16 bytes
// longer. Yet all releases of version 2 give their ports the same names, and every process opens the port of its
// domain's multicast. So 2.9.1 and another release 2 on one host, such as those of ROS 2, read each other's memory
// wrongly, and mostly one of them aborts at once (a failed assertion in Boost).
#pragma once

#include <cstdint>

#include "fastdds_versions/names.hpp"

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

}  // namespace rmw_fastrtps
