// SPDX-License-Identifier: Apache-2.0
// Reading UTF-8, one character at a time.
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

// The first character of a text that isn't empty. Overlong forms and surrogates are not valid.
CodePoint decode_utf8(std::string_view text);

void append_utf8(std::string& text, char32_t character);

}  // namespace launch
