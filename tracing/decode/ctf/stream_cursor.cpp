// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/stream_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace tracing::ctf {
namespace {

constexpr std::uint64_t kByte = 8;           // bits
constexpr std::uint64_t kBlock = 4096;       // bytes
constexpr std::uint64_t kMargin = 4096;      // bytes; longer than nearly all events
constexpr std::size_t kWindow = 128 << 10;   // bytes
constexpr std::size_t kLargest = 256 << 20;  // bytes; no event is larger

std::uint64_t aligned(std::uint64_t bit, std::uint32_t alignment) {
  return (bit + alignment - 1) & ~std::uint64_t{alignment - 1};
}

}  // namespace

StreamCursor::StreamCursor(const StreamLayout& layout, std::vector<Packet> packets)
    : layout_(layout),
      nanosecond_clock_(layout.clock().frequency == 1'000'000'000),
      packets_(std::move(packets)),
      places_(3 * EventLayout::kMostSimpleFields) {
  if (nanosecond_clock_) {
    nanosecond_offset_ = static_cast<std::uint64_t>(layout.clock().nanoseconds(0));
  }
}

StreamCursor::Item StreamCursor::next() {
  for (;;) {
    if (!losses_.empty()) {
      const Loss loss = losses_.back();
      losses_.pop_back();
      time_ns_ = loss.begin_ns;
      loss_end_ns_ = loss.end_ns;
      lost_ = loss.count;
      return loss.kind;
    }
    if (at_ < limit_ || !is_last_window_) {
      try {
        read_event();
      } catch (...) {
        at_ = limit_;
        is_last_window_ = true;
        throw;
      }
      return Item::kEvent;
    }
    if (!open_packet()) {
      return Item::kEnd;
    }
  }
}

bool StreamCursor::open_packet() {
  if (next_packet_ == packets_.size()) {
    window_ = {};
    return false;
  }
  const Packet& packet = packets_[next_packet_];
  find_losses(packet);
  ++next_packet_;
  // An empty window; read_event() moves it.
  window_offset_ = 0;
  at_ = packet.events_bit;
  limit_ = at_;
  is_last_window_ = packet.content_bits == packet.events_bit;
  if (packet.time_begin) {
    cycles_ = *packet.time_begin;
  }
  return true;
}

// Makes the window begin at the next event, or shortly before it.
void StreamCursor::move_window(std::size_t size) {
  const std::uint64_t content_bytes = (packet().content_bits + kByte - 1) / kByte;
  // Alignments count from the beginning of the packet; none is larger than a block.
  const std::uint64_t offset = (window_offset_ + at_ / kByte) / kBlock * kBlock;
  const std::uint64_t count = std::min<std::uint64_t>(size, content_bytes - offset);
  // Numbers are read as whole words, also at the end of the window.
  if (window_.size() < count + sizeof(std::uint64_t)) {
    window_.resize(count + sizeof(std::uint64_t));
  }
  packet().file->read(window_.data(), count, packet().offset + offset);
  at_ -= (offset - window_offset_) * kByte;
  window_offset_ = offset;
  is_last_window_ = offset + count == content_bytes;
  begin_ = window_.data();
  end_ = begin_ + count;
  limit_ = is_last_window_ ? packet().content_bits - offset * kByte : count * kByte;
}

void StreamCursor::find_losses(const Packet& packet) {
  const Packet* const before = next_packet_ > 0 ? &packets_[next_packet_ - 1] : nullptr;
  const std::int64_t begin = nanoseconds(packet.time_begin.value_or(0));
  const std::int64_t end = nanoseconds(packet.time_end.value_or(packet.time_begin.value_or(0)));
  const std::int64_t end_before = before != nullptr ? nanoseconds(before->time_end.value_or(0)) : begin;
  // In the opposite order: the last loss is reported first.
  if (packet.discarded_events) {
    const std::uint64_t now = *packet.discarded_events;
    if (before == nullptr) {
      // A running total: it is not known how much of it belongs to this trace.
      if (now > 0) {
        losses_.push_back({Item::kDiscardedEvents, std::nullopt, begin, end});
      }
    } else if (before->discarded_events && now > discarded_) {
      losses_.push_back({Item::kDiscardedEvents, now - discarded_, end_before, end});
    }
    // Under overload LTTng now and then writes 0 in a packet and goes on from the total before it.
    discarded_ = std::max(discarded_, now);
  }
  if (before != nullptr && before->sequence_number && packet.sequence_number &&
      *packet.sequence_number > *before->sequence_number + 1) {
    losses_.push_back({Item::kLostPackets, *packet.sequence_number - *before->sequence_number - 1, end_before, begin});
  }
}

// Called for each event, as decode_event(): docs/performance.md says what inlining them brings.
[[gnu::always_inline]] inline std::uint64_t StreamCursor::number(std::uint64_t header,
                                                                 HeaderLayout::Number place) const {
  const std::uint64_t bit = header + place.bit;
  const std::uint8_t* const byte = begin_ + bit / kByte;
  if (!layout_.header().is_big_endian && std::endian::native == std::endian::little && bit % kByte + place.size <= 64) {
    std::uint64_t value = 0;
    std::memcpy(&value, byte, sizeof value);
    value >>= bit % kByte;
    return place.size == 64 ? value : value & ((std::uint64_t{1} << place.size) - 1);
  }
  return read_bits(begin_, bit, place.size, layout_.header().is_big_endian);
}

// A time holds only the lower bits of the clock, which has advanced since the previous event.
void StreamCursor::advance_clock(std::uint64_t value, std::uint32_t bits) {
  if (bits >= 64) {
    cycles_ = value;
    return;
  }
  const std::uint64_t range = std::uint64_t{1} << bits;
  const std::uint64_t lower = cycles_ & (range - 1);
  cycles_ = cycles_ - lower + value + (value < lower ? range : 0);
}

void StreamCursor::read_event() {
  if (!is_last_window_ && limit_ - at_ < kMargin * kByte) {
    move_window(kWindow);
  }
  const std::uint64_t cycles = cycles_;
  // Where a large event does not fit into the window, a larger window is tried.
  for (std::size_t size = 2 * kWindow;; size *= 2) {
    try {
      return decode_event();
    } catch (const DamagedPacket&) {
      if (is_last_window_ || size > kLargest) {
        throw;
      }
    }
    cycles_ = cycles;
    move_window(size);
  }
}

[[gnu::always_inline]] inline void StreamCursor::decode_event() {
  const HeaderLayout& layout = layout_.header();
  const std::uint64_t header = aligned(at_, layout.alignment);
  const HeaderLayout::Form* form = &layout.short_form;
  if (header + layout.first_id.bit + layout.first_id.size > limit_) {
    throw DamagedPacket("an event goes beyond the end of its packet");
  }
  std::uint64_t id = layout.first_id.size > 0 ? number(header, layout.first_id) : 0;
  if (layout.has_long_form && id >= layout.long_first && id <= layout.long_last) {
    form = &layout.long_form;
  }
  if (header + form->end > limit_) {
    throw DamagedPacket("an event goes beyond the end of its packet");
  }
  if (form->id.size > 0) {
    id = number(header, form->id);
  }
  advance_clock(number(header, form->time), form->time.size);
  time_ns_ = nanoseconds(cycles_);
  event_ = layout_.event(id);
  if (event_ == nullptr) {
    throw UndescribedPacket(fmt::format("an event has the unknown number {}", id));
  }
  read_structures(header + form->end);
}

// Returns the first byte behind the structure.
inline const std::uint8_t* StreamCursor::read_simple(const StructureDecoder& decoder, const std::uint8_t* at,
                                                     StructureDecoder::Place* places, Record& record) {
  record.decoder = &decoder;
  record.base = at;
  record.fields = nullptr;
  if (const auto size = decoder.fixed_size()) {
    if (*size > static_cast<std::size_t>(end_ - at)) {
      throw DamagedPacket("an event goes beyond the end of its packet");
    }
    record.places = decoder.fixed_places();
    return at + *size;
  }
  record.places = places;
  const std::uint8_t* const behind = decoder.decode(at, end_, places);
  if (behind == nullptr) {
    throw DamagedPacket("an event goes beyond the end of its packet");
  }
  return behind;
}

void StreamCursor::read_structures(std::uint64_t bit) {
  if (event_->is_simple) [[likely]] {
    constexpr std::size_t kEach = EventLayout::kMostSimpleFields;
    const std::uint8_t* at = begin_ + (bit + kByte - 1) / kByte;
    at = read_simple(layout_.event_context(), at, places_.data(), stream_context_);
    at = read_simple(event_->context, at, places_.data() + kEach, event_context_);
    at = read_simple(event_->payload, at, places_.data() + 2 * kEach, payload_);
    at_ = static_cast<std::uint64_t>(at - begin_) * kByte;
    return;
  }
  struct Part {
    const StructureDecoder& decoder;
    Record& record;
    std::string_view path;
  };
  const Part parts[] = {{layout_.event_context(), stream_context_, "stream.event.context"},
                        {event_->context, event_context_, "event.context"},
                        {event_->payload, payload_, "event.fields"}};
  arena_.reset();
  std::vector<FieldScope> scopes;
  std::vector<Field> structures;
  structures.reserve(std::size(parts));
  for (const Part& part : parts) {
    part.record = {};
    if (part.decoder.type() == nullptr) {
      continue;
    }
    structures.push_back(decode_structure(*part.decoder.type(), begin_, bit, limit_, scopes, arena_, bit));
    part.record.decoder = &part.decoder;
    part.record.fields = structures.back().children;
    scopes.push_back({part.path, &structures.back()});
  }
  at_ = bit;
}

}  // namespace tracing::ctf
