// SPDX-License-Identifier: Apache-2.0
#include "launcher/base/utf8.hpp"

namespace launch {

CodePoint decode_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) {
    return {first, 1, true};
  }
  if (first < 0xC2 || first > 0xF4) {
    return {};
  }
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (size > text.size()) {
    return {};
  }
  char32_t value = first & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return {};
    }
    value = (value << 6U) | (byte(i) & 0x3FU);
  }
  const bool overlong = (size == 3 && value < 0x800) || (size == 4 && value < 0x10000);
  const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (overlong || surrogate || value > 0x10FFFF) {
    return {};
  }
  return {value, size, true};
}

void append_utf8(std::string& text, char32_t character) {
  const auto add = [&](char32_t byte) { text += static_cast<char>(byte); };
  if (character < 0x80) {
    add(character);
  } else if (character < 0x800) {
    add(0xC0 | (character >> 6U));
    add(0x80 | (character & 0x3FU));
  } else if (character < 0x10000) {
    add(0xE0 | (character >> 12U));
    add(0x80 | ((character >> 6U) & 0x3FU));
    add(0x80 | (character & 0x3FU));
  } else {
    add(0xF0 | (character >> 18U));
    add(0x80 | ((character >> 12U) & 0x3FU));
    add(0x80 | ((character >> 6U) & 0x3FU));
    add(0x80 | (character & 0x3FU));
  }
}

}  // namespace launch
