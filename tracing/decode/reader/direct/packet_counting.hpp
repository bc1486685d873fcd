// SPDX-License-Identifier: Apache-2.0
// Counts the events of several streams, in one thread for each processor if there is much to count. Private to the
// reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/packet.hpp"

namespace tracing {

// Those on which this process may run.
std::size_t usable_processors();

struct CountedStream {
  const ctf::StreamLayout& layout;
  const std::vector<ctf::Packet>& packets;
  std::vector<std::uint64_t> counts;  // by EventLayout::index; has a place for each declaration of the trace
};

// Adds up the events of each stream. Returns false when a packet is damaged; the counts then mean nothing.
bool count_packets(std::vector<CountedStream>& streams);

}  // namespace tracing
