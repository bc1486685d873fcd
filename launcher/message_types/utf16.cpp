// SPDX-License-Identifier: Apache-2.0
#include "launcher/message_types/utf16.hpp"

#include "base/text/utf8.hpp"

namespace launch {

namespace {

constexpr char32_t kReplacement = 0xFFFD;
constexpr char32_t kFirstPair = 0x10000;

}  // namespace

std::u16string to_utf16(std::string_view utf8) {
  std::u16string text;
  while (!utf8.empty()) {
    const CodePoint character = decode_utf8(utf8);
    utf8.remove_prefix(character.size);
    const char32_t value = character.valid ? character.value : kReplacement;
    if (value < kFirstPair) {
      text += static_cast<char16_t>(value);
    } else {
      text += static_cast<char16_t>(0xD800 + ((value - kFirstPair) >> 10));
      text += static_cast<char16_t>(0xDC00 + ((value - kFirstPair) & 0x3FF));
    }
  }
  return text;
}

std::string to_utf8(std::u16string_view utf16) {
  std::string text;
  for (std::size_t i = 0; i < utf16.size(); ++i) {
    char32_t value = utf16[i];
    const bool is_high = value >= 0xD800 && value < 0xDC00;
    if (is_high && i + 1 < utf16.size() && utf16[i + 1] >= 0xDC00 && utf16[i + 1] < 0xE000) {
      value = kFirstPair + ((value - 0xD800) << 10) + (utf16[++i] - 0xDC00);
    } else if (value >= 0xD800 && value < 0xE000) {
      value = kReplacement;
    }
    append_utf8(text, value);
  }
  return text;
}

}  // namespace launch
