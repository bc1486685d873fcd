// SPDX-License-Identifier: Apache-2.0
// Goes through the events and losses of one stream in the order of time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/packet.hpp"
#include "tracing/decode/ctf/streams/block_decoder.hpp"
#include "tracing/decode/ctf/streams/event_block.hpp"
#include "tracing/decode/ctf/streams/read_ahead.hpp"
#include "tracing/decode/ctf/streams/stream_losses.hpp"
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
  enum class Item { kEvent, kLoss, kEnd };

  // Packets in the order of time. The layout must outlive the cursor.
  StreamCursor(const StreamLayout& layout, std::vector<Packet> packets) : decoder_(layout, std::move(packets)) {}
  ~StreamCursor() { stop_reading_ahead(); }
  StreamCursor(const StreamCursor&) = delete;
  StreamCursor& operator=(const StreamCursor&) = delete;

  const StreamLayout& layout() const { return decoder_.layout(); }
  const std::vector<Packet>& packets() const { return decoder_.packets(); }

  // Before the first item: about how many bytes of packets are read at once.
  void set_block_size(std::size_t bytes) { decoder_.set_block_size(bytes); }
  // From now on `threads` decode what comes next. They must be there until stop_reading_ahead().
  void read_ahead(ReadAhead& threads);
  void stop_reading_ahead();

  // Moves to the next item. Throws DamagedPacket at the first damage in a packet; a later call goes on with the next
  // packet.
  [[gnu::always_inline]] Item next() {
    while (next_item_ == items_end_) {
      if (!next_block()) {
        return Item::kEnd;
      }
    }
    const EventBlock::Item& item = *next_item_++;
    time_ns_ = item.time_ns;
    packet_ = item.packet;
    if (item.kind != EventBlock::Item::Kind::kSimple) {
      return next_other(item);
    }
    event_ = item.event;
    const StructureDecoder& stream_context = layout().event_context();
    if (event_->fixed_size) [[likely]] {
      if (!is_fixed_) {
        is_fixed_ = true;
        stream_context_ = {&stream_context, nullptr, stream_context.fixed_places(), nullptr};
        event_context_ = payload_ = {};
      }
      stream_context_.base = item.base;
      event_context_.decoder = &event_->context;
      event_context_.base = item.base + item.event_context;
      event_context_.places = event_->context.fixed_places();
      payload_.decoder = &event_->payload;
      payload_.base = item.base + item.payload;
      payload_.places = event_->payload.fixed_places();
    } else {
      is_fixed_ = false;
      const StructureDecoder::Place* places = block_->places.data() + item.index;
      set(stream_context_, stream_context, item.base, places);
      set(event_context_, event_->context, item.base + item.event_context, places);
      set(payload_, event_->payload, item.base + item.payload, places);
    }
    return Item::kEvent;
  }

  // The time of the item in nanoseconds since the epoch. For a loss it is the earliest time at which the loss began.
  std::int64_t time_ns() const { return time_ns_; }

  // The event that the item is.
  const EventLayout& event() const { return *event_; }
  const Packet& packet() const { return packets()[packet_]; }
  std::size_t packet_number() const { return packet_; }
  const Record& stream_context() const { return stream_context_; }
  const Record& event_context() const { return event_context_; }
  const Record& payload() const { return payload_; }

  // The loss that the item is.
  const StreamLoss& loss() const { return *loss_; }

 private:
  static void set(Record& record, const StructureDecoder& decoder, const std::uint8_t* base,
                  const StructureDecoder::Place*& places) {
    const bool is_fixed = decoder.fixed_size().has_value();
    record = {&decoder, base, is_fixed ? decoder.fixed_places() : places, nullptr};
    places += is_fixed ? 0 : decoder.size();
  }
  Item next_other(const EventBlock::Item& item);
  bool next_block();

  BlockDecoder decoder_;
  std::unique_ptr<EventBlock> block_;
  const EventBlock::Item* next_item_ = nullptr;  // in the block
  const EventBlock::Item* items_end_ = nullptr;

  ReadAhead* threads_ = nullptr;
  ReadAhead::Task ahead_;
  std::unique_ptr<EventBlock> block_ahead_;
  bool is_filled_ahead_ = false;  // the block ahead is filled

  std::int64_t time_ns_ = 0;
  std::size_t packet_ = 0;
  const EventLayout* event_ = nullptr;
  bool is_fixed_ = false;  // the last event: what its records have in common with others is there
  Record stream_context_;
  Record event_context_;
  Record payload_;
  const StreamLoss* loss_ = nullptr;
};

}  // namespace tracing::ctf
