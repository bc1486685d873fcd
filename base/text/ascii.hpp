// SPDX-License-Identifier: Apache-2.0
// Blanks and capital letters of ASCII. Bytes of other characters stay as they are, whatever the locale.
#pragma once

#include <string>
#include <string_view>

namespace launch {

// The text without the blanks at both ends.
inline std::string_view trim(std::string_view text, std::string_view blanks = " \t\n\r") {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

inline std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

}  // namespace launch
