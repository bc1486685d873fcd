// SPDX-License-Identifier: Apache-2.0
// Bytes that are written bit by bit.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace tracing::testing {

// Bits in the order of CTF: little-endian numbers begin at the lowest bit of each byte, big-endian numbers at the
// highest.
class BitWriter {
 public:
  explicit BitWriter(bool big_endian) : big_endian_(big_endian) {}

  void align(std::uint32_t alignment) {
    while (size_ % alignment != 0) {
      bit(false);
    }
  }
  void number(std::uint64_t value, std::uint32_t bits) {
    for (std::uint32_t i = 0; i < bits; ++i) {
      bit(((value >> (big_endian_ ? bits - 1 - i : i)) & 1) != 0);
    }
  }
  void text(const std::string& text) {
    for (const char c : text) {
      number(static_cast<std::uint8_t>(c), 8);
    }
    number(0, 8);
  }
  std::uint64_t size() const { return size_; }
  void patch(std::uint64_t at, std::uint64_t value, std::uint32_t bits) {
    const std::uint64_t end = std::exchange(size_, at);
    number(value, bits);
    size_ = end;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void bit(bool set) {
    if (size_ / 8 == bytes_.size()) {
      bytes_.push_back('\0');
    }
    const auto mask = static_cast<char>(1U << (big_endian_ ? 7 - size_ % 8 : size_ % 8));
    char& byte = bytes_[size_ / 8];
    byte = static_cast<char>(set ? byte | mask : byte & ~mask);
    ++size_;
  }

  bool big_endian_;
  std::string bytes_;
  std::uint64_t size_ = 0;
};

}  // namespace tracing::testing
