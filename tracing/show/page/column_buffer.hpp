// SPDX-License-Identifier: Apache-2.0
// Columns of numbers as the page holds them: each number takes as few bytes as it needs (LEB128). All columns together
// are compressed (gzip) and written as text (base64).
#pragma once

#include <cstdint>
#include <string>

namespace tracing {

class ColumnBuffer {
 public:
  void add(std::uint64_t number) {
    while (number >= 0x80) {
      bytes_ += static_cast<char>(number | 0x80);
      number >>= 7;
    }
    bytes_ += static_cast<char>(number);
  }
  // Small negative numbers are short, too: 0, -1, 1, -2, … become 0, 1, 2, 3, …
  void add_signed(std::int64_t number) {
    add(static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63));
  }

  std::string compressed_text() const;

 private:
  std::string bytes_;
};

}  // namespace tracing
