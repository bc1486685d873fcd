// SPDX-License-Identifier: Apache-2.0
// Goes through the events and losses of one stream in the order of time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/structure_decoder.hpp"

namespace tracing::ctf {

// The fields of one structure of one event.
struct Record {
  const StructureDecoder* decoder = nullptr;  // null: there is no such structure
  const std::uint8_t* base = nullptr;         // of a simple structure: its first byte
  const StructureDecoder::Place* places = nullptr;
  const Field* fields = nullptr;  // of any other structure

  std::size_t size() const { return decoder == nullptr ? 0 : decoder->size(); }
  Field operator[](std::size_t index) const {  // index < size()
    if (places == nullptr) {
      return fields[index];
    }
    return {decoder->type()->members[index].type.get(), base, std::uint64_t{places[index].offset} * 8,
            places[index].length, nullptr};
  }
};

class StreamCursor {
 public:
  enum class Item {
    kEvent,
    kDiscardedEvents,  // the tracer had no room for these events
    kLostPackets,      // packets were overwritten before they were read
    kEnd,
  };

  // Packets in the order of time. The layout must outlive the cursor.
  StreamCursor(const StreamLayout& layout, std::vector<Packet> packets);

  // Moves to the next item. Throws DamagedPacket at the first damage in a packet; a later call goes on with the next
  // packet.
  Item next();

  // The time of the item in nanoseconds since the epoch. For a loss it is the earliest time at which the loss began.
  std::int64_t time_ns() const { return time_ns_; }

  // The event that the item is.
  const EventLayout& event() const { return *event_; }
  const Packet& packet() const { return packets_[next_packet_ - 1]; }
  const Record& stream_context() const { return stream_context_; }
  const Record& event_context() const { return event_context_; }
  const Record& payload() const { return payload_; }

  // For a loss: how many events or packets, if known, and the latest time at which it had ended.
  std::optional<std::uint64_t> lost() const { return lost_; }
  std::int64_t loss_end_ns() const { return loss_end_ns_; }

 private:
  bool open_packet();
  void move_window(std::size_t size);
  void decode_event();
  void find_losses(const Packet& packet);
  void read_event();
  void read_structures(std::uint64_t bit);
  const std::uint8_t* read_simple(const StructureDecoder& decoder, const std::uint8_t* at,
                                  StructureDecoder::Place* places, Record& record);
  std::uint64_t number(std::uint64_t header, HeaderLayout::Number place) const;
  void advance_clock(std::uint64_t value, std::uint32_t bits);
  std::int64_t nanoseconds(std::uint64_t cycles) const {
    return nanosecond_clock_ ? static_cast<std::int64_t>(cycles + nanosecond_offset_)
                             : layout_.clock().nanoseconds(cycles);
  }

  struct Loss {
    Item kind;
    std::optional<std::uint64_t> count;
    std::int64_t begin_ns;
    std::int64_t end_ns;
  };

  const StreamLayout& layout_;
  bool nanosecond_clock_;
  std::uint64_t nanosecond_offset_ = 0;
  std::vector<Packet> packets_;
  std::size_t next_packet_ = 0;
  std::uint64_t discarded_ = 0;  // the highest total of discarded events in the packets so far
  std::vector<Loss> losses_;     // to be reported before the events of the packet, the last one first

  // A window of the open packet's content. Bits count from the beginning of the window.
  std::vector<std::uint8_t> window_;
  std::uint64_t window_offset_ = 0;  // bytes from the beginning of the packet
  bool is_last_window_ = true;       // the window reaches the end of the content
  const std::uint8_t* begin_ = nullptr;
  const std::uint8_t* end_ = nullptr;  // of the content in the window, rounded up to bytes
  std::uint64_t at_ = 0;               // bits
  std::uint64_t limit_ = 0;            // bits
  std::uint64_t cycles_ = 0;

  std::int64_t time_ns_ = 0;
  const EventLayout* event_ = nullptr;
  Record stream_context_;
  Record event_context_;
  Record payload_;
  std::vector<StructureDecoder::Place> places_;  // of the three structures, one structure after the other
  FieldArena arena_;
  std::optional<std::uint64_t> lost_;
  std::int64_t loss_end_ns_ = 0;
};

}  // namespace tracing::ctf
