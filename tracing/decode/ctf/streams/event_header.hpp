// SPDX-License-Identifier: Apache-2.0
// Reads the headers of events. Done for each event: docs/performance.md says what inlining it brings.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "tracing/decode/ctf/event_layout.hpp"
#include "tracing/decode/ctf/field.hpp"

namespace tracing::ctf {

struct EventHeader {
  std::uint64_t bit = 0;  // where it begins
  std::uint64_t id = 0;
  const HeaderLayout::Form* form = nullptr;

  std::uint64_t end() const { return bit + form->end; }
};

// A number of the header that begins at `bit`. Bits count from `begin`; eight bytes behind the number may be read.
[[gnu::always_inline]] inline std::uint64_t header_number(const HeaderLayout& layout, const std::uint8_t* begin,
                                                          std::uint64_t bit, HeaderLayout::Number number) {
  const std::uint64_t at = bit + number.bit;
  if (!layout.is_big_endian && std::endian::native == std::endian::little && at % 8 + number.size <= 64) {
    std::uint64_t value = 0;
    std::memcpy(&value, begin + at / 8, sizeof value);
    value >>= at % 8;
    return number.size == 64 ? value : value & ((std::uint64_t{1} << number.size) - 1);
  }
  return read_bits(begin, at, number.size, layout.is_big_endian);
}

// The header of the event that begins at `at` or, aligned, behind it. Throws DamagedPacket when it goes beyond `limit`.
[[gnu::always_inline]] inline EventHeader read_header(const HeaderLayout& layout, const std::uint8_t* begin,
                                                      std::uint64_t at, std::uint64_t limit) {
  EventHeader header;
  header.bit = (at + layout.alignment - 1) & ~std::uint64_t{layout.alignment - 1};
  header.form = &layout.short_form;
  if (header.bit + layout.first_id.bit + layout.first_id.size > limit) {
    throw DamagedPacket("an event goes beyond the end of its packet");
  }
  header.id = layout.first_id.size > 0 ? header_number(layout, begin, header.bit, layout.first_id) : 0;
  if (layout.has_long_form && header.id >= layout.long_first && header.id <= layout.long_last) {
    header.form = &layout.long_form;
  }
  if (header.end() > limit) {
    throw DamagedPacket("an event goes beyond the end of its packet");
  }
  if (header.form->id.size > 0) {
    header.id = header_number(layout, begin, header.bit, header.form->id);
  }
  return header;
}

}  // namespace tracing::ctf
