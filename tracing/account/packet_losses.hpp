// SPDX-License-Identifier: Apache-2.0
// What the packets of a recording tell of losses. They are what a reader of the trace sees, so they decide.
#pragma once

#include <cstdint>
#include <vector>

#include "tracing/account/loss_account.hpp"
#include "tracing/account/stream_packets.hpp"

namespace tracing {

// Of one stream. Losses in it are those that every reader of CTF finds: a packet's total of discarded events less that
// of the packet before it, and gaps between sequence numbers.
struct PacketLosses {
  std::uint64_t discarded_events = 0;  // also of the first packet, if it is the stream's first of all
  std::uint64_t lost_packets = 0;
  std::uint64_t earlier_packets = 0;           // before the first that is there
  std::uint64_t earlier_discarded_events = 0;  // before the end of the first that is there
};
PacketLosses losses_of(const Stream& stream);

// Replaces the session daemon's counts of each channel with those of its packets. A channel without a packet keeps the
// daemon's. What the daemon counts beyond the packets is added: it never got into one.
//
// The daemon alone would be wrong: it forgets processes that have ended with buffers of their own, and it does not see
// what files of a limited size have overwritten.
void count_in_packets(LossAccount& account, const std::vector<Stream>& streams);

}  // namespace tracing
