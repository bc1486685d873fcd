// SPDX-License-Identifier: Apache-2.0
// Some events of a stream, one after the other, with the bytes that they are views of. One thread may fill a block
// while another one reads the block before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/streams/byte_arena.hpp"
#include "tracing/decode/ctf/streams/general_event.hpp"
#include "tracing/decode/ctf/streams/stream_losses.hpp"
#include "tracing/decode/ctf/structure_decoder.hpp"

namespace tracing::ctf {

struct EventBlock {
  // `size`: about how many bytes of packets it has.
  explicit EventBlock(std::size_t size) : bytes(size + sizeof(std::uint64_t)) {}

  // Events of a few bytes, and those that are not simple, take more memory as items than as bytes.
  static constexpr std::size_t kMostItems = 1 << 13;

  struct Item {
    enum class Kind : std::uint8_t {
      kSimple,  // an event (EventLayout::is_simple)
      kOther,   // any other event
      kLoss,
      kDamage,  // the rest of the packet can't be read
    };
    std::int64_t time_ns;
    const EventLayout* event;
    // Of a simple event: where its structures begin, and where the places of those that have no fixed ones begin in
    // `places`.
    const std::uint8_t* base;
    std::uint32_t event_context;  // bytes from the base, where the contexts of the stream begin
    std::uint32_t payload;
    std::uint32_t index;  // of a simple event: in `places`; else in the list of its kind
    std::uint32_t packet;
    Kind kind;
  };
  struct Damage {
    std::string what;
    bool is_undescribed = false;  // UndescribedPacket
  };

  ByteArena bytes;
  void add(const Item& item) { items[count++] = item; }  // count < kMostItems

  std::unique_ptr<Item[]> items = std::make_unique_for_overwrite<Item[]>(kMostItems);  // memory is used when it is
  std::size_t count = 0;                                                               // of items
  std::vector<StructureDecoder::Place> places;
  FieldArena fields;  // of those that are not simple
  std::vector<GeneralEvent> others;
  std::vector<StreamLoss> losses;
  std::vector<Damage> damages;
  bool is_last = false;      // nothing comes behind it
  std::exception_ptr error;  // what has ended the decoding, if it is no damage

  void clear();
};

}  // namespace tracing::ctf
