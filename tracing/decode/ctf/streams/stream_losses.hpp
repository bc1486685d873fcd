// SPDX-License-Identifier: Apache-2.0
// Finds what is missing between the packets of a stream.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {

struct StreamLoss {
  bool of_packets = false;             // else: of events
  std::optional<std::uint64_t> count;  // if known
  std::int64_t begin_ns = 0;           // the earliest time at which it began
  std::int64_t end_ns = 0;             // the latest time at which it had ended
};

class StreamLosses {
 public:
  // The clock must outlive this object.
  explicit StreamLosses(const Clock& clock) : clock_(clock) {}

  // Adds the losses before the events of a packet to the list, the last one first. To be asked for each packet in the
  // order of time; `before`: the one before, or null.
  void find(const Packet* before, const Packet& packet, std::vector<StreamLoss>& losses);

 private:
  const Clock& clock_;
  std::uint64_t discarded_ = 0;  // the highest total of discarded events in the packets so far
};

// All losses of a stream.
std::vector<StreamLoss> losses_of(const std::vector<Packet>& packets, const Clock& clock);

}  // namespace tracing::ctf
