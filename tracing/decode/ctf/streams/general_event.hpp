// SPDX-License-Identifier: Apache-2.0
// Decodes the structures of an event that is not simple (EventLayout::is_simple).
#pragma once

#include <array>
#include <cstdint>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/structure_decoder.hpp"

namespace tracing::ctf {

// The members of the contexts of the stream, of those of the event, and of the payload; null: there is no such
// structure. They are in the arena.
struct GeneralEvent {
  std::array<const Field*, 3> members{};
  std::uint64_t end = 0;  // the bit behind the event
};

// Throws DamagedPacket.
GeneralEvent decode_general_event(const StreamLayout& stream, const EventLayout& event, const std::uint8_t* begin,
                                  std::uint64_t bit, std::uint64_t limit, FieldArena& arena);

}  // namespace tracing::ctf
