// SPDX-License-Identifier: Apache-2.0
// The value of one field, as a view into the packet that holds it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "tracing/decode/ctf/field_class.hpp"

namespace tracing::ctf {

// Reads `size` bits (at most 64) from `bit` on, where bit 0 is the first bit of the packet.
std::uint64_t read_bits(const std::uint8_t* packet, std::uint64_t bit, std::uint32_t size, bool big_endian);

// Reads a number that begins at a byte and has the machine's byte order, its bits extended to 64. Not for kBits.
[[gnu::always_inline]] inline std::uint64_t load_number(const std::uint8_t* bytes, NumberAccess access) {
  const auto load = [bytes]<class Number>(Number number) {
    std::memcpy(&number, bytes, sizeof number);
    return number;
  };
  switch (access) {
    case NumberAccess::kUnsigned8:
      return *bytes;
    case NumberAccess::kUnsigned16:
      return load(std::uint16_t{});
    case NumberAccess::kUnsigned32:
      return load(std::uint32_t{});
    case NumberAccess::kSigned8:
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(static_cast<std::int8_t>(*bytes)));
    case NumberAccess::kSigned16:
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(load(std::int16_t{})));
    case NumberAccess::kSigned32:
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(load(std::int32_t{})));
    case NumberAccess::kUnsigned64:
    case NumberAccess::kSigned64:
    case NumberAccess::kBits:
      break;
  }
  return load(std::uint64_t{});
}

struct Field {
  const FieldClass* type = nullptr;
  const std::uint8_t* packet = nullptr;  // where the packet begins
  std::uint64_t bit = 0;                 // where the field begins in the packet
  std::uint64_t length = 0;              // elements of an array or a sequence; bytes of a string
  // Fields inside: the members of a structure, the one selected member of a variant, the elements of an array whose
  // elements have no fixed size. Null: the elements follow one another with a fixed size.
  const Field* children = nullptr;

  // The value of an integer or an enumeration; unsigned_integer() only for unsigned ones.
  std::optional<std::uint64_t> unsigned_integer() const;
  std::optional<std::int64_t> integer() const;  // when it fits
  std::optional<double> real() const;
  std::optional<std::string_view> string() const;  // of strings and of arrays of characters
  // An element of an array or a sequence, or a member of a structure; index < length, or the number of members.
  Field child(std::size_t index) const;
  // The label of an enumeration's value; empty when it has none.
  std::string_view label() const;

  // Any number but a real one, its bits extended to 64.
  std::uint64_t raw() const {
    return type->access == NumberAccess::kBits ? raw_bits() : load_number(packet + bit / 8, type->access);
  }

 private:
  std::uint64_t raw_bits() const;
};

inline std::optional<std::uint64_t> Field::unsigned_integer() const {
  if (type->is_signed || (type->kind != FieldKind::kInteger && type->kind != FieldKind::kEnumeration)) {
    return std::nullopt;
  }
  return raw();
}

inline std::optional<std::int64_t> Field::integer() const {
  if (type->kind != FieldKind::kInteger && type->kind != FieldKind::kEnumeration) {
    return std::nullopt;
  }
  const auto value = static_cast<std::int64_t>(raw());
  if (!type->is_signed && value < 0) {
    return std::nullopt;
  }
  return value;
}

}  // namespace tracing::ctf
