// SPDX-License-Identifier: Apache-2.0
#include "tracing/ctf/stream_cursor.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace tracing::ctf {
namespace {

constexpr std::uint64_t kByte = 8;  // bits

std::uint64_t aligned(std::uint64_t bit, std::uint32_t alignment) {
  return (bit + alignment - 1) & ~std::uint64_t{alignment - 1};
}

}  // namespace

StreamCursor::StreamCursor(const StreamLayout& layout, std::vector<Packet> packets)
    : layout_(layout), nanosecond_clock_(layout.clock().frequency == 1'000'000'000), packets_(std::move(packets)) {
  if (nanosecond_clock_) nanosecond_offset_ = static_cast<std::uint64_t>(layout.clock().nanoseconds(0));
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
    if (at_ < limit_) {
      try {
        read_event();
      } catch (...) {
        at_ = limit_;
        throw;
      }
      return Item::kEvent;
    }
    if (!open_packet()) return Item::kEnd;
  }
}

bool StreamCursor::open_packet() {
  if (next_packet_ > 0) {
    const Packet& done = packets_[next_packet_ - 1];
    done.file->forget(done.begin, done.begin + done.content_bits / kByte);
  }
  if (next_packet_ == packets_.size()) return false;
  const Packet& packet = packets_[next_packet_];
  find_losses(packet);
  ++next_packet_;
  begin_ = packet.begin;
  at_ = packet.events_bit;
  limit_ = packet.content_bits;
  end_ = begin_ + (limit_ + kByte - 1) / kByte;
  file_end_ = packet.file->end();
  if (packet.time_begin) cycles_ = *packet.time_begin;
  return true;
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
      if (now > 0) losses_.push_back({Item::kDiscardedEvents, std::nullopt, begin, end});
    } else if (before->discarded_events && now > *before->discarded_events) {
      losses_.push_back({Item::kDiscardedEvents, now - *before->discarded_events, end_before, end});
    }
  }
  if (before != nullptr && before->sequence_number && packet.sequence_number &&
      *packet.sequence_number > *before->sequence_number + 1) {
    losses_.push_back({Item::kLostPackets, *packet.sequence_number - *before->sequence_number - 1, end_before, begin});
  }
}

std::uint64_t StreamCursor::number(std::uint64_t header, HeaderLayout::Number place) const {
  const std::uint64_t bit = header + place.bit;
  const std::uint8_t* const byte = begin_ + bit / kByte;
  if (!layout_.header().is_big_endian && std::endian::native == std::endian::little && bit % kByte + place.size <= 64 &&
      byte + sizeof(std::uint64_t) <= file_end_) {
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
  const HeaderLayout& layout = layout_.header();
  const std::uint64_t header = aligned(at_, layout.alignment);
  const HeaderLayout::Form* form = &layout.short_form;
  if (header + layout.first_id.bit + layout.first_id.size > limit_) {
    throw DamagedPacket("an event goes beyond the end of its packet");
  }
  std::uint64_t id = layout.first_id.size > 0 ? number(header, layout.first_id) : 0;
  if (layout.has_long_form && id >= layout.long_first && id <= layout.long_last) form = &layout.long_form;
  if (header + form->end > limit_) throw DamagedPacket("an event goes beyond the end of its packet");
  if (form->id.size > 0) id = number(header, form->id);
  advance_clock(number(header, form->time), form->time.size);
  time_ns_ = nanoseconds(cycles_);
  event_ = layout_.event(id);
  if (event_ == nullptr) throw DamagedPacket(fmt::format("an event has the unknown number {}", id));
  read_structures(header + form->end);
}

void StreamCursor::read_structures(std::uint64_t bit) {
  struct Part {
    const StructureDecoder& decoder;
    Record& record;
    std::string_view path;
  };
  const Part parts[] = {{layout_.event_context(), stream_context_, "stream.event.context"},
                        {event_->context, event_context_, "event.context"},
                        {event_->payload, payload_, "event.fields"}};
  if (parts[0].decoder.is_simple() && parts[1].decoder.is_simple() && parts[2].decoder.is_simple()) [[likely]] {
    const std::uint8_t* at = begin_ + (bit + kByte - 1) / kByte;
    std::size_t used = 0;
    for (const Part& part : parts) {
      if (part.decoder.size() == 0) {
        part.record = {};
        continue;
      }
      part.record.decoder = &part.decoder;
      part.record.base = at;
      part.record.fields = nullptr;
      if (const auto size = part.decoder.fixed_size()) {
        if (*size > static_cast<std::size_t>(end_ - at))
          throw DamagedPacket("an event goes beyond the end of its packet");
        part.record.places = part.decoder.fixed_places();
        at += *size;
        continue;
      }
      // Places of an earlier part must stay at their addresses.
      constexpr std::size_t kMost = 256;
      if (places_.size() < 3 * kMost) places_.resize(3 * kMost);
      if (part.decoder.size() > kMost) throw DamagedPacket("an event has too many fields");
      StructureDecoder::Place* const places = places_.data() + used;
      at = part.decoder.decode(at, end_, places);
      if (at == nullptr) throw DamagedPacket("an event goes beyond the end of its packet");
      part.record.places = places;
      used += kMost;
    }
    at_ = static_cast<std::uint64_t>(at - begin_) * kByte;
    return;
  }
  arena_.reset();
  std::vector<FieldScope> scopes;
  std::vector<Field> structures;
  structures.reserve(std::size(parts));
  for (const Part& part : parts) {
    part.record = {};
    if (part.decoder.type() == nullptr) continue;
    structures.push_back(decode_structure(*part.decoder.type(), begin_, bit, limit_, scopes, arena_, bit));
    part.record.decoder = &part.decoder;
    part.record.fields = structures.back().children;
    scopes.push_back({part.path, &structures.back()});
  }
  at_ = bit;
}

}  // namespace tracing::ctf
