// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/protocol/wire.hpp"

#include <limits>

namespace launch {
namespace {

constexpr unsigned kByte = 8;

template <typename Number>
void append_number(std::string& bytes, Number value) {
  for (std::size_t i = sizeof value; i-- > 0;) {
    bytes += static_cast<char>((value >> (i * kByte)) & 0xffU);
  }
}

template <typename Number>
Number number_of(std::string_view bytes) {
  Number value = 0;
  for (const char byte : bytes) {
    value = static_cast<Number>(value << kByte) | static_cast<std::uint8_t>(byte);
  }
  return value;
}

}  // namespace

WireWriter& WireWriter::u8(std::uint8_t value) {
  bytes_ += static_cast<char>(value);
  return *this;
}

WireWriter& WireWriter::u32(std::uint32_t value) {
  append_number(bytes_, value);
  return *this;
}

WireWriter& WireWriter::u64(std::uint64_t value) {
  append_number(bytes_, value);
  return *this;
}

WireWriter& WireWriter::text(std::string_view value) {
  if (value.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw WireError("a text is too long for a message");
  }
  u32(static_cast<std::uint32_t>(value.size()));
  return rest(value);
}

WireWriter& WireWriter::rest(std::string_view bytes) {
  bytes_ += bytes;
  return *this;
}

std::string_view WireReader::take(std::size_t size) {
  if (size > left_.size()) {
    throw WireError("a message ends too early");
  }
  const std::string_view taken = left_.substr(0, size);
  left_.remove_prefix(size);
  return taken;
}

std::uint8_t WireReader::u8() {
  return number_of<std::uint8_t>(take(sizeof(std::uint8_t)));
}

std::uint32_t WireReader::u32() {
  return number_of<std::uint32_t>(take(sizeof(std::uint32_t)));
}

std::uint64_t WireReader::u64() {
  return number_of<std::uint64_t>(take(sizeof(std::uint64_t)));
}

bool WireReader::flag() {
  const std::uint8_t value = u8();
  if (value > 1) {
    throw WireError("a message has something else than yes or no");
  }
  return value == 1;
}

std::uint32_t WireReader::count(std::size_t least) {
  const std::uint32_t number = u32();
  if (number > left_.size() / (least > 0 ? least : 1)) {
    throw WireError("a message has a list that is longer than the message");
  }
  return number;
}

std::string_view WireReader::rest() {
  return take(left_.size());
}

void WireReader::end() const {
  if (!left_.empty()) {
    throw WireError("a message is longer than it should be");
  }
}

}  // namespace launch
