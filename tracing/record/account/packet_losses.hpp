// SPDX-License-Identifier: Apache-2.0
// What the packets of a recording tell of losses. They are what a reader of the trace sees, so they decide.
#pragma once

#include <cstdint>
#include <vector>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

// All events that the stream has discarded since its beginning, as its packets tell: the highest of their totals. Under
// overload LTTng now and then writes a packet whose total is 0; the totals behind it go on from the one before.
std::uint64_t discarded_in(const Stream& stream);

// The packets that are missing between two packets that follow each other in their stream.
std::uint64_t packets_between(const Packet& before, const Packet& after);

// The losses of one stream: the climb of the total of discarded events over all its packets, and gaps between sequence
// numbers.
struct PacketLosses {
  std::uint64_t discarded_events = 0;  // also of the first packet, if it is the stream's first of all
  std::uint64_t lost_packets = 0;
  std::uint64_t earlier_packets = 0;           // before the first that is there
  std::uint64_t earlier_discarded_events = 0;  // before the end of the first that is there
};
PacketLosses losses_of(const Stream& stream);

// Replaces the session daemon's counts of each channel with the counts of its packets. A channel without a packet keeps
// the counts of the daemon. If the daemon has counted more than the packets, the difference is added: these losses were
// never written into a packet.
//
// The daemon alone would be wrong: it forgets processes that have ended with buffers of their own, and it does not see
// what files of a limited size have overwritten.
void count_in_packets(LossAccount& account, const std::vector<Stream>& streams);

}  // namespace tracing
