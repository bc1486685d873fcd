// SPDX-License-Identifier: Apache-2.0
// Reads, writes, checks and repairs UTF-8. Overlong forms, surrogates and what is beyond U+10FFFF are not UTF-8.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace launch {

struct CodePoint {
  char32_t value = 0;
  std::size_t size = 1;  // bytes it takes; 1 when not valid
  bool valid = false;
};

// The first character of a text that isn't empty.
CodePoint decode_utf8(std::string_view text);

// Whether it is a byte within a character, not its first one.
constexpr bool is_continuation_byte(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

void append_utf8(std::string& text, char32_t character);

bool is_utf8(std::string_view bytes);

// Appends the bytes with U+FFFD in place of each part that is not UTF-8. Such a part is the longest start of a
// character that does not go on (Unicode 15, section 3.9, "substitution of maximal subparts"). Python's
// errors="replace" does the same.
void append_as_utf8(std::string& to, std::string_view bytes);

// Number of bytes at the end that begin a character whose rest may still come (0 to 3).
std::size_t incomplete_utf8_suffix(std::string_view bytes);

}  // namespace launch
