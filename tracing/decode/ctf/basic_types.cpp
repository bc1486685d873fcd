// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/basic_types.hpp"

#include <fmt/format.h>

#include <bit>
#include <utility>

namespace tracing::ctf {
namespace {

constexpr std::uint32_t kByte = 8;  // bits

NumberAccess access_of(const FieldClass& number) {
  const bool native = number.is_big_endian == (std::endian::native == std::endian::big) || number.size == kByte;
  if (number.kind == FieldKind::kReal || number.alignment % kByte != 0 || !native) {
    return NumberAccess::kBits;
  }
  switch (number.size) {
    case 8:
      return number.is_signed ? NumberAccess::kSigned8 : NumberAccess::kUnsigned8;
    case 16:
      return number.is_signed ? NumberAccess::kSigned16 : NumberAccess::kUnsigned16;
    case 32:
      return number.is_signed ? NumberAccess::kSigned32 : NumberAccess::kUnsigned32;
    case 64:
      return number.is_signed ? NumberAccess::kSigned64 : NumberAccess::kUnsigned64;
    default:
      return NumberAccess::kBits;
  }
}

std::uint8_t base_of(const TsdlEntry& entry) {
  if (entry.value.kind == TsdlValue::Kind::kNumber) {
    return static_cast<std::uint8_t>(entry.value.number);
  }
  const std::string& name = entry.value.text;
  if (name == "hexadecimal" || name == "hex" || name == "x" || name == "X" || name == "p") {
    return 16;
  }
  if (name == "octal" || name == "oct" || name == "o") {
    return 8;
  }
  if (name == "binary" || name == "b") {
    return 2;
  }
  return 10;
}

// clock.NAME.value
std::string clock_of(const TsdlEntry& entry) {
  std::string_view path = entry.value.text;
  if (!path.starts_with("clock.") || !path.ends_with(".value")) {
    fail_at_line(entry.line, "an integer has an unknown map");
  }
  path.remove_prefix(6);
  path.remove_suffix(6);
  return std::string(path);
}

}  // namespace

std::uint64_t number_of(const TsdlEntry& entry) {
  if (entry.value.kind != TsdlValue::Kind::kNumber) {
    fail_at_line(entry.line, fmt::format("'{}' is no number", entry.name));
  }
  return static_cast<std::uint64_t>(entry.value.number);
}

std::uint32_t checked_alignment(std::uint64_t alignment, std::size_t line) {
  if (alignment == 0 || !std::has_single_bit(alignment) || alignment > 4096) {
    fail_at_line(line, fmt::format("bad alignment {}", alignment));
  }
  return static_cast<std::uint32_t>(alignment);
}

bool is_big_endian(const std::string& order, bool native_is_big_endian, std::size_t line) {
  if (order == "le") {
    return false;
  }
  if (order == "be" || order == "network") {
    return true;
  }
  if (order == "native") {
    return native_is_big_endian;
  }
  fail_at_line(line, fmt::format("unknown byte order '{}'", order));
}

FieldClassPtr integer_type(const std::vector<TsdlEntry>& entries, bool native_is_big_endian, std::size_t line) {
  FieldClass integer;
  integer.is_big_endian = native_is_big_endian;
  integer.alignment = 0;
  for (const TsdlEntry& entry : entries) {
    const std::string& text = entry.value.text;
    if (entry.name == "size") {
      integer.size = static_cast<std::uint32_t>(number_of(entry));
    }
    if (entry.name == "align") {
      integer.alignment = checked_alignment(number_of(entry), entry.line);
    }
    if (entry.name == "signed") {
      integer.is_signed = text.empty() ? entry.value.number != 0 : text == "true" || text == "TRUE";
    }
    if (entry.name == "byte_order") {
      integer.is_big_endian = is_big_endian(text, native_is_big_endian, entry.line);
    }
    if (entry.name == "encoding") {
      integer.is_text = text == "UTF8" || text == "utf8" || text == "ASCII" || text == "ascii";
    }
    if (entry.name == "base") {
      integer.base = base_of(entry);
    }
    if (entry.name == "map") {
      integer.clock = clock_of(entry);
    }
  }
  if (integer.size == 0 || integer.size > 64) {
    fail_at_line(line, fmt::format("an integer of {} bits", integer.size));
  }
  if (integer.alignment == 0) {
    integer.alignment = integer.size % kByte == 0 ? kByte : 1;
  }
  integer.access = access_of(integer);
  return complete(std::move(integer));
}

FieldClassPtr real_type(const std::vector<TsdlEntry>& entries, bool native_is_big_endian, std::size_t line) {
  FieldClass real;
  real.kind = FieldKind::kReal;
  real.is_big_endian = native_is_big_endian;
  for (const TsdlEntry& entry : entries) {
    if (entry.name == "exp_dig" || entry.name == "mant_dig") {
      real.size += static_cast<std::uint32_t>(number_of(entry));
    }
    if (entry.name == "align") {
      real.alignment = checked_alignment(number_of(entry), entry.line);
    }
    if (entry.name == "byte_order") {
      real.is_big_endian = is_big_endian(entry.value.text, native_is_big_endian, entry.line);
    }
  }
  if (real.size != 32 && real.size != 64) {
    fail_at_line(line, fmt::format("a number of {} bits", real.size));
  }
  return complete(std::move(real));
}

FieldClassPtr string_type() {
  FieldClass string;
  string.kind = FieldKind::kString;
  string.alignment = kByte;
  return complete(std::move(string));
}

}  // namespace tracing::ctf
