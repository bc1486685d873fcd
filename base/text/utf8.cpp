// SPDX-License-Identifier: Apache-2.0
#include "base/text/utf8.hpp"

#include <cstdint>
#include <cstring>

namespace launch {
namespace {

enum class Part { kValid, kInvalid, kCutOff };

struct Sequence {
  Part part;
  std::size_t length;
};

// The character at the start of non-empty `bytes`, or the maximal part there that is no character (Unicode 15, table
// 3-7).
Sequence first_sequence(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  const std::uint8_t lead = at(0);
  if (lead < 0x80) {
    return {Part::kValid, 1};
  }
  std::size_t length = 0;
  std::uint8_t low = 0x80;  // bounds of the second byte; the others are 80..BF
  std::uint8_t high = 0xBF;
  if (lead >= 0xC2 && lead <= 0xDF) {
    length = 2;
  } else if (lead >= 0xE0 && lead <= 0xEF) {
    length = 3;
    low = lead == 0xE0 ? 0xA0 : 0x80;
    high = lead == 0xED ? 0x9F : 0xBF;
  } else if (lead >= 0xF0 && lead <= 0xF4) {
    length = 4;
    low = lead == 0xF0 ? 0x90 : 0x80;
    high = lead == 0xF4 ? 0x8F : 0xBF;
  } else {
    return {Part::kInvalid, 1};
  }
  for (std::size_t i = 1; i < length; ++i) {
    if (i == bytes.size()) {
      return {Part::kCutOff, i};
    }
    if (at(i) < low || at(i) > high) {
      return {Part::kInvalid, i};
    }
    low = 0x80;
    high = 0xBF;
  }
  return {Part::kValid, length};
}

// Length of the ASCII text at the start.
std::size_t ascii_prefix(std::string_view bytes) {
  std::size_t i = 0;
  for (; i + sizeof(std::uint64_t) <= bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, sizeof word);
    if ((word & 0x8080808080808080U) != 0) {
      break;
    }
  }
  while (i < bytes.size() && static_cast<std::uint8_t>(bytes[i]) < 0x80) {
    ++i;
  }
  return i;
}

// Length of the valid text at the start.
std::size_t valid_prefix(std::string_view bytes) {
  std::size_t i = ascii_prefix(bytes);
  while (i < bytes.size()) {
    const Sequence sequence = first_sequence(bytes.substr(i));
    if (sequence.part != Part::kValid) {
      break;
    }
    i += sequence.length;
    i += ascii_prefix(bytes.substr(i));
  }
  return i;
}

}  // namespace

CodePoint decode_utf8(std::string_view text) {
  const Sequence sequence = first_sequence(text);
  if (sequence.part != Part::kValid) {
    return {};
  }
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (sequence.length == 1) {
    return {byte(0), 1, true};
  }
  char32_t value = byte(0) & (0x7FU >> sequence.length);
  for (std::size_t i = 1; i < sequence.length; ++i) {
    value = (value << 6U) | (byte(i) & 0x3FU);
  }
  return {value, sequence.length, true};
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

bool is_utf8(std::string_view bytes) {
  return valid_prefix(bytes) == bytes.size();
}

void append_as_utf8(std::string& to, std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t valid = valid_prefix(bytes);
    to.append(bytes.substr(0, valid));
    bytes.remove_prefix(valid);
    if (!bytes.empty()) {
      to.append("\xEF\xBF\xBD");
      bytes.remove_prefix(first_sequence(bytes).length);
    }
  }
}

std::size_t incomplete_utf8_suffix(std::string_view bytes) {
  for (std::size_t length = 1; length <= 3 && length <= bytes.size(); ++length) {
    const std::string_view suffix = bytes.substr(bytes.size() - length);
    const Sequence sequence = first_sequence(suffix);
    if (sequence.part == Part::kCutOff && sequence.length == length) {
      return length;
    }
  }
  return 0;
}

}  // namespace launch
