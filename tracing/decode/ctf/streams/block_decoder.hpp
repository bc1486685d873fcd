// SPDX-License-Identifier: Apache-2.0
// Goes through the packets of one stream and finds their events, block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/streams/event_block.hpp"
#include "tracing/decode/ctf/streams/packet_window.hpp"
#include "tracing/decode/ctf/streams/stream_losses.hpp"

namespace tracing::ctf {

class BlockDecoder {
 public:
  // Packets in the order of time. The layout must outlive the decoder.
  BlockDecoder(const StreamLayout& layout, std::vector<Packet> packets);

  const StreamLayout& layout() const { return layout_; }
  const std::vector<Packet>& packets() const { return packets_; }

  // Before the first block: about how many bytes of packets a block has.
  void set_block_size(std::size_t bytes) {
    block_size_ = bytes;
    window_ = PacketWindow(bytes);
  }
  std::size_t block_size() const { return block_size_; }
  // Fills the block with the next events, losses and damages. Throws nothing: EventBlock::error.
  void fill(EventBlock& block);

 private:
  bool open_packet(EventBlock& block);
  static bool has_room_for_items(const EventBlock& block);
  bool has_room(const EventBlock& block) const;  // also for another part of the file
  void decode_packet(EventBlock& block);
  void decode_window(EventBlock& block);
  void decode_usual_events(EventBlock& block);
  const std::uint8_t* find_structures(EventBlock& block, EventBlock::Item& item, const std::uint8_t* end) const;
  void add_damage(EventBlock& block, const char* what, bool is_undescribed);
  std::int64_t nanoseconds(std::uint64_t cycles) const {
    return nanosecond_clock_ ? static_cast<std::int64_t>(cycles + nanosecond_offset_)
                             : layout_.clock().nanoseconds(cycles);
  }

  const StreamLayout& layout_;
  bool nanosecond_clock_;
  std::uint64_t nanosecond_offset_ = 0;
  std::vector<Packet> packets_;
  std::size_t next_packet_ = 0;
  StreamLosses find_losses_;
  std::size_t block_size_ = 64 << 10;
  PacketWindow window_{block_size_};
  std::uint64_t cycles_ = 0;
};

}  // namespace tracing::ctf
