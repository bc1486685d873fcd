// SPDX-License-Identifier: Apache-2.0
// Columns of numbers as the page holds them: each number takes as few bytes as it needs (LEB128). All columns together
// are compressed (gzip) and written as text (base64), while they are made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

namespace tracing {

using WriteText = std::function<void(std::string_view)>;

class ColumnBuffer {
 public:
  // `write` gets the text, part by part.
  explicit ColumnBuffer(WriteText write);
  ~ColumnBuffer();
  ColumnBuffer(const ColumnBuffer&) = delete;
  ColumnBuffer& operator=(const ColumnBuffer&) = delete;

  void add(std::uint64_t number) {
    if (size_ + kLongest > bytes_.size()) {
      compress(false);
    }
    while (number >= 0x80) {
      bytes_[size_++] = static_cast<std::uint8_t>(number | 0x80);
      number >>= 7;
    }
    bytes_[size_++] = static_cast<std::uint8_t>(number);
  }
  // Small negative numbers are short, too: 0, -1, 1, -2, … become 0, 1, 2, 3, …
  void add_signed(std::int64_t number) {
    add(static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63));
  }

  // To be called once, at the end.
  void finish() { compress(true); }

 private:
  static constexpr std::size_t kLongest = 10;  // bytes of a number
  class Compressor;
  void compress(bool is_end);

  std::unique_ptr<Compressor> compressor_;
  std::array<std::uint8_t, 64 << 10> bytes_;
  std::size_t size_ = 0;
};

}  // namespace tracing
