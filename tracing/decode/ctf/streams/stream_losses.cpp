// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/stream_losses.hpp"

#include <algorithm>

namespace tracing::ctf {

void StreamLosses::find(const Packet* before, const Packet& packet, std::vector<StreamLoss>& losses) {
  const std::int64_t begin = clock_.nanoseconds(packet.time_begin.value_or(0));
  const std::int64_t end = clock_.nanoseconds(packet.time_end.value_or(packet.time_begin.value_or(0)));
  const std::int64_t end_before = before != nullptr ? clock_.nanoseconds(before->time_end.value_or(0)) : begin;
  if (packet.discarded_events) {
    const std::uint64_t now = *packet.discarded_events;
    if (before == nullptr) {
      // A running total: it is not known how much of it belongs to this trace.
      if (now > 0) {
        losses.push_back({false, std::nullopt, begin, end});
      }
    } else if (before->discarded_events && now > discarded_) {
      losses.push_back({false, now - discarded_, end_before, end});
    }
    // Under overload LTTng now and then writes 0 in a packet and goes on from the total before it.
    discarded_ = std::max(discarded_, now);
  }
  if (before != nullptr && before->sequence_number && packet.sequence_number &&
      *packet.sequence_number > *before->sequence_number + 1) {
    losses.push_back({true, *packet.sequence_number - *before->sequence_number - 1, end_before, begin});
  }
}

std::vector<StreamLoss> losses_of(const std::vector<Packet>& packets, const Clock& clock) {
  StreamLosses find(clock);
  std::vector<StreamLoss> losses;
  const Packet* before = nullptr;
  for (const Packet& packet : packets) {
    find.find(before, packet, losses);
    before = &packet;
  }
  return losses;
}

}  // namespace tracing::ctf
