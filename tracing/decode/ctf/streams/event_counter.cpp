// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/event_counter.hpp"

#include <fmt/format.h>

#include "tracing/decode/ctf/streams/event_header.hpp"
#include "tracing/decode/ctf/streams/general_event.hpp"

namespace tracing::ctf {

void EventCounter::count(const StreamLayout& layout, const Packet& packet, std::vector<std::uint64_t>& counts) {
  window_.open(packet);
  while (window_.has_more()) {
    bytes_.reset();
    window_.use(bytes_);
    window_.with_event([&] { count_in_window(layout, counts); });
  }
}

// The next event, and all others that begin before the safe limit.
void EventCounter::count_in_window(const StreamLayout& layout, std::vector<std::uint64_t>& counts) {
  const std::uint8_t* const begin = window_.begin();
  const std::uint8_t* const end = window_.end();
  const std::uint64_t limit = window_.limit();
  const std::uint64_t safe_limit = window_.safe_limit();
  std::uint64_t* const count = counts.data();
  std::uint64_t at = window_.at;
  do {
    const EventHeader header = read_header(layout.header(), begin, at, limit);
    const EventLayout* const event = layout.event(header.id);
    if (event == nullptr) {
      throw UndescribedPacket(fmt::format("an event has the unknown number {}", header.id));
    }
    if (event->fixed_size) [[likely]] {
      const std::uint8_t* const structures = begin + (header.end() + 7) / 8;
      if (*event->fixed_size > static_cast<std::size_t>(end - structures)) {
        throw DamagedPacket("an event goes beyond the end of its packet");
      }
      at = static_cast<std::uint64_t>(structures + *event->fixed_size - begin) * 8;
    } else {
      at = end_of(layout, *event, header.end());
    }
    window_.at = at;
    ++count[event->index];
  } while (at < safe_limit);
}

std::uint64_t EventCounter::end_of(const StreamLayout& layout, const EventLayout& event, std::uint64_t bit) {
  const std::uint8_t* const begin = window_.begin();
  if (!event.is_simple) {
    fields_.reset();
    return decode_general_event(layout, event, begin, bit, window_.limit(), fields_).end;
  }
  const std::uint8_t* at = begin + (bit + 7) / 8;
  for (const StructureDecoder* decoder : {&layout.event_context(), &event.context, &event.payload}) {
    at = decoder->decode(at, window_.end(), places_.data());
    if (at == nullptr) {
      throw DamagedPacket("an event goes beyond the end of its packet");
    }
  }
  return static_cast<std::uint64_t>(at - begin) * 8;
}

}  // namespace tracing::ctf
