// SPDX-License-Identifier: Apache-2.0
// Keeps processes of different releases of Fast DDS out of each other's shared memory.
//
// Release 2.9.1 lays out its ports like no other one, but gives them the same names (shared_memory_layout.hpp).
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

#include "fastdds_versions/shared_memory_layout.hpp"

#if RMW_FASTDDS_MAJOR >= 3
#include <fastdds/rtps/transport/TransportInterface.hpp>
#else
#include <fastdds/rtps/transport/TransportInterface.h>
#endif

namespace rmw_fastrtps {

// Where the two bytes of the host are in each locator of shared memory that a message announces for a participant or an
// endpoint: places in `message`, which has an RTPS header.
std::vector<std::size_t> announced_hosts(std::span<const std::uint8_t> message);

// Puts before a transport what separates its memory, if this release needs it.
std::unique_ptr<rtps::TransportInterface> with_separate_memory(std::unique_ptr<rtps::TransportInterface> transport);

}  // namespace rmw_fastrtps
