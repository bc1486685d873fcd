// SPDX-License-Identifier: Apache-2.0
// Numbers and texts as bytes, for the messages between a launcher and its agents: numbers of fixed width, the highest
// byte first; a text is its length in four bytes and its bytes, which may be any.
//
// What is read comes from another machine and may be anything. The reader never looks beyond the end, and takes no
// memory for what is not there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace launch {

// Bytes that are no message of this protocol. One line, without the place.
class WireError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class WireWriter {
 public:
  WireWriter& u8(std::uint8_t value);
  WireWriter& u32(std::uint32_t value);
  WireWriter& u64(std::uint64_t value);
  WireWriter& i32(std::int32_t value) { return u32(static_cast<std::uint32_t>(value)); }
  WireWriter& i64(std::int64_t value) { return u64(static_cast<std::uint64_t>(value)); }
  WireWriter& flag(bool value) { return u8(value ? 1 : 0); }
  // Throws WireError for more than 4 GiB.
  WireWriter& text(std::string_view value);
  // Without a length: the rest of the message.
  WireWriter& rest(std::string_view bytes);

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// All functions throw WireError when the bytes end before the value does.
class WireReader {
 public:
  explicit WireReader(std::string_view bytes) : left_(bytes) {}

  std::uint8_t u8();
  std::uint32_t u32();
  std::uint64_t u64();
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
  std::int64_t i64() { return static_cast<std::int64_t>(u64()); }
  // Throws for a byte that is neither 0 nor 1.
  bool flag();
  std::string text() { return std::string(view()); }
  // The number of elements of a list. Each takes at least `least` bytes, so that no number is greater than what the
  // message can hold.
  std::uint32_t count(std::size_t least);
  // All that is left.
  std::string_view rest();
  // Throws if something is left.
  void end() const;

 private:
  std::string_view take(std::size_t size);
  std::string_view view() { return take(u32()); }

  std::string_view left_;
};

}  // namespace launch
