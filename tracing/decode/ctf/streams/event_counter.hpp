// SPDX-License-Identifier: Apache-2.0
// Counts the events of packets. It goes from event to event as StreamCursor does and finds the same damage, but knows
// neither their times nor where their fields are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/streams/byte_arena.hpp"
#include "tracing/decode/ctf/streams/packet_window.hpp"

namespace tracing::ctf {

class EventCounter {
 public:
  // Adds the events of a packet to `counts`, which has a place for each declaration of the trace (EventLayout::index).
  // Throws DamagedPacket.
  void count(const StreamLayout& layout, const Packet& packet, std::vector<std::uint64_t>& counts);

 private:
  void count_in_window(const StreamLayout& layout, std::vector<std::uint64_t>& counts);
  std::uint64_t end_of(const StreamLayout& layout, const EventLayout& event, std::uint64_t bit);

  static constexpr std::size_t kWindow = 128 << 10;  // bytes
  ByteArena bytes_{kWindow + 2 * sizeof(std::uint64_t)};
  PacketWindow window_{kWindow};
  std::vector<StructureDecoder::Place> places_ = std::vector<StructureDecoder::Place>(EventLayout::kMostSimpleFields);
  FieldArena fields_;
};

}  // namespace tracing::ctf
