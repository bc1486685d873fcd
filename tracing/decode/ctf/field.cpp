// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/field.hpp"

#include <algorithm>
#include <bit>

namespace tracing::ctf {

std::uint64_t read_bits(const std::uint8_t* packet, std::uint64_t bit, std::uint32_t size, bool big_endian) {
  const std::uint8_t* byte = packet + bit / 8;
  const auto skipped = static_cast<std::uint32_t>(bit % 8);
  std::uint64_t value = 0;
  for (std::uint32_t done = 0; done < size;) {
    const std::uint32_t from = done == 0 ? skipped : 0;  // the first bit of this byte that counts
    const std::uint32_t count = std::min(8 - from, size - done);
    const std::uint32_t mask = (1U << count) - 1;
    if (big_endian) {
      value = (value << count) | ((static_cast<std::uint32_t>(*byte) >> (8 - from - count)) & mask);
    } else {
      value |= static_cast<std::uint64_t>((static_cast<std::uint32_t>(*byte) >> from) & mask) << done;
    }
    done += count;
    ++byte;
  }
  return value;
}

std::uint64_t Field::raw_bits() const {
  const std::uint64_t value = read_bits(packet, bit, type->size, type->is_big_endian);
  if (!type->is_signed || type->size == 64) {
    return value;
  }
  const std::uint64_t sign = std::uint64_t{1} << (type->size - 1);
  return (value ^ sign) - sign;
}

std::optional<double> Field::real() const {
  if (type->kind != FieldKind::kReal) {
    return std::nullopt;
  }
  const std::uint64_t bits = read_bits(packet, bit, type->size, type->is_big_endian);
  if (type->size == 64) {
    return std::bit_cast<double>(bits);
  }
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

std::optional<std::string_view> Field::string() const {
  const auto* const bytes = reinterpret_cast<const char*>(packet + bit / 8);
  if (type->kind == FieldKind::kString) {
    return std::string_view(bytes, length);
  }
  if (!type->is_characters()) {
    return std::nullopt;
  }
  return std::string_view(bytes, strnlen(bytes, length));
}

Field Field::child(std::size_t index) const {
  if (children != nullptr) {
    return children[index];
  }
  const FieldClass& element = *type->element;
  const std::uint64_t step = (element.size + element.alignment - 1) / element.alignment * element.alignment;
  return {&element, packet, bit + index * step, 0, nullptr};
}

std::string_view Field::label() const {
  if (type->kind != FieldKind::kEnumeration) {
    return {};
  }
  const std::uint64_t value = raw();
  for (const EnumerationRange& range : type->ranges) {
    const bool in_range =
        type->is_signed
            ? static_cast<std::int64_t>(value) >= range.first && static_cast<std::int64_t>(value) <= range.last
            : value >= static_cast<std::uint64_t>(range.first) && value <= static_cast<std::uint64_t>(range.last);
    if (in_range) {
      return range.label;
    }
  }
  return {};
}

}  // namespace tracing::ctf
