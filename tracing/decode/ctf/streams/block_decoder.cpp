// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/block_decoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

#include "tracing/decode/ctf/streams/event_header.hpp"

namespace tracing::ctf {
namespace {

using Item = EventBlock::Item;

constexpr std::size_t kFew = 4;  // more than the losses before a packet, an event and a damage

std::uint64_t word_at(const std::uint8_t* bytes) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

// A time holds only the lower bits of the clock, which has advanced since the previous event.
std::uint64_t advanced(std::uint64_t cycles, std::uint64_t value, std::uint32_t bits) {
  if (bits >= 64) {
    return value;
  }
  const std::uint64_t range = std::uint64_t{1} << bits;
  const std::uint64_t lower = cycles & (range - 1);
  return cycles - lower + value + (value < lower ? range : 0);
}

}  // namespace

BlockDecoder::BlockDecoder(const StreamLayout& layout, std::vector<Packet> packets)
    : layout_(layout),
      nanosecond_clock_(layout.clock().frequency == 1'000'000'000),
      packets_(std::move(packets)),
      find_losses_(layout.clock()) {
  if (nanosecond_clock_) {
    nanosecond_offset_ = static_cast<std::uint64_t>(layout.clock().nanoseconds(0));
  }
}

bool BlockDecoder::has_room_for_items(const EventBlock& block) {
  constexpr std::size_t kMostOthers = 256;  // each has many fields
  return block.others.size() < kMostOthers && block.count + kFew < EventBlock::kMostItems;
}

bool BlockDecoder::has_room(const EventBlock& block) const {
  return has_room_for_items(block) && block.bytes.used() < block_size_;
}

void BlockDecoder::fill(EventBlock& block) {
  block.clear();
  try {
    window_.use(block.bytes);
    while (has_room(block)) {
      if (window_.has_more()) {
        decode_packet(block);
      } else if (!open_packet(block)) {
        block.is_last = true;
        return;
      }
    }
  } catch (...) {
    block.error = std::current_exception();
    block.is_last = true;
  }
}

bool BlockDecoder::open_packet(EventBlock& block) {
  if (next_packet_ == packets_.size()) {
    return false;
  }
  const Packet& packet = packets_[next_packet_];
  const auto before = static_cast<std::ptrdiff_t>(block.losses.size());
  find_losses_.find(next_packet_ > 0 ? &packets_[next_packet_ - 1] : nullptr, packet, block.losses);
  std::reverse(block.losses.begin() + before, block.losses.end());
  for (std::size_t i = static_cast<std::size_t>(before); i < block.losses.size(); ++i) {
    Item item{};
    item.time_ns = block.losses[i].begin_ns;
    item.index = static_cast<std::uint32_t>(i);
    item.packet = static_cast<std::uint32_t>(next_packet_);
    item.kind = Item::Kind::kLoss;
    block.add(item);
  }
  ++next_packet_;
  window_.open(packet);
  if (packet.time_begin) {
    cycles_ = *packet.time_begin;
  }
  return true;
}

// Until the block is full, or the packet ends.
void BlockDecoder::decode_packet(EventBlock& block) {
  try {
    do {
      window_.with_event([&] { decode_window(block); });
    } while (window_.has_more() && has_room(block));
  } catch (const UndescribedPacket& damage) {
    add_damage(block, damage.what(), true);
  } catch (const DamagedPacket& damage) {
    add_damage(block, damage.what(), false);
  }
}

// The next event, and all others that begin before the safe limit.
void BlockDecoder::decode_window(EventBlock& block) {
  const HeaderLayout& layout = layout_.header();
  const std::uint8_t* const begin = window_.begin();
  const std::uint8_t* const end = window_.end();
  const std::uint64_t limit = window_.limit();
  const std::uint64_t safe_limit = window_.safe_limit();
  Item item{};
  item.packet = static_cast<std::uint32_t>(next_packet_ - 1);
  do {
    if (layout_.usual_header().is_known && window_.at % 8 == 0) {
      const std::uint64_t at = window_.at;
      decode_usual_events(block);
      if (window_.at != at && (window_.at >= safe_limit || !has_room_for_items(block))) {
        return;
      }
    }
    const EventHeader header = read_header(layout, begin, window_.at, limit);
    const HeaderLayout::Number time = header.form->time;
    const std::uint64_t cycles = advanced(cycles_, header_number(layout, begin, header.bit, time), time.size);
    item.time_ns = nanoseconds(cycles);
    item.event = layout_.event(header.id);
    if (item.event == nullptr) {
      throw UndescribedPacket(fmt::format("an event has the unknown number {}", header.id));
    }
    if (item.event->is_simple) [[likely]] {
      const std::uint8_t* at = begin + (header.end() + 7) / 8;
      item.kind = Item::Kind::kSimple;
      item.base = at;
      if (item.event->fixed_size) [[likely]] {
        if (*item.event->fixed_size > static_cast<std::size_t>(end - at)) {
          throw DamagedPacket("an event goes beyond the end of its packet");
        }
        item.event_context = item.event->context_offset;
        item.payload = item.event->payload_offset;
        at += *item.event->fixed_size;
      } else {
        at = find_structures(block, item, end);
      }
      window_.at = static_cast<std::uint64_t>(at - begin) * 8;
    } else {
      const GeneralEvent found = decode_general_event(layout_, *item.event, begin, header.end(), limit, block.fields);
      item.kind = Item::Kind::kOther;
      item.index = static_cast<std::uint32_t>(block.others.size());
      block.others.push_back(found);
      window_.at = found.end;
    }
    cycles_ = cycles;
    block.add(item);
  } while (window_.at < safe_limit && has_room_for_items(block));
}

// Those that begin before the safe limit, up to the first one that is not usual.
void BlockDecoder::decode_usual_events(EventBlock& block) {
  const UsualHeader header = layout_.usual_header();
  const UsualEvent* const events = layout_.usual_events().data();
  const std::size_t count = layout_.usual_events().size();
  const std::uint8_t* const begin = window_.begin();
  const std::uint8_t* const end = begin + window_.limit() / 8;
  const std::uint8_t* const safe_end = begin + window_.safe_limit() / 8;
  const std::uint8_t* at = begin + window_.at / 8;
  const auto packet = static_cast<std::uint32_t>(next_packet_ - 1);
  Item* item = block.items.get() + block.count;
  const Item* const items_end = block.items.get() + EventBlock::kMostItems - kFew;
  std::uint64_t cycles = cycles_;
  while (at < safe_end && item < items_end) {
    // Behind the window there are eight bytes to read.
    const std::uint64_t id = (word_at(at) >> header.id_shift) & header.id_mask;
    if (id >= count) {
      break;
    }
    const UsualEvent& event = events[id];
    if (event.layout == nullptr || event.bytes > static_cast<std::size_t>(end - at)) {
      break;
    }
    const std::uint64_t time = (word_at(at + header.time_byte) >> header.time_shift) & header.time_mask;
    const std::uint64_t lower = cycles & header.time_mask;
    cycles += time - lower + (time < lower ? header.time_mask + 1 : 0);
    // One member after the other: a copy of a whole item would have to wait for each of them.
    item->time_ns = nanoseconds(cycles);
    item->event = event.layout;
    item->base = at + event.header_bytes;
    item->event_context = event.context_offset;
    item->payload = event.payload_offset;
    item->index = 0;
    item->packet = packet;
    item->kind = Item::Kind::kSimple;
    ++item;
    at += event.bytes;
  }
  block.count = static_cast<std::size_t>(item - block.items.get());
  window_.at = static_cast<std::uint64_t>(at - begin) * 8;
  cycles_ = cycles;
}

// Returns the first byte behind them.
const std::uint8_t* BlockDecoder::find_structures(EventBlock& block, Item& item, const std::uint8_t* end) const {
  const StructureDecoder* const decoders[] = {&layout_.event_context(), &item.event->context, &item.event->payload};
  std::uint32_t offsets[std::size(decoders)];
  const std::uint8_t* at = item.base;
  item.index = static_cast<std::uint32_t>(block.places.size());
  for (std::size_t i = 0; i < std::size(decoders); ++i) {
    offsets[i] = static_cast<std::uint32_t>(at - item.base);
    if (const auto size = decoders[i]->fixed_size()) {
      at = *size > static_cast<std::size_t>(end - at) ? nullptr : at + *size;
    } else {
      const std::size_t first = block.places.size();
      block.places.resize(first + decoders[i]->size());
      at = decoders[i]->decode(at, end, block.places.data() + first);
    }
    if (at == nullptr) {
      throw DamagedPacket("an event goes beyond the end of its packet");
    }
  }
  item.event_context = offsets[1];
  item.payload = offsets[2];
  return at;
}

void BlockDecoder::add_damage(EventBlock& block, const char* what, bool is_undescribed) {
  Item item{};
  item.kind = Item::Kind::kDamage;
  item.index = static_cast<std::uint32_t>(block.damages.size());
  item.packet = static_cast<std::uint32_t>(next_packet_ - 1);
  block.damages.push_back({what, is_undescribed});
  block.add(item);
  window_.skip_rest();
}

}  // namespace tracing::ctf
