// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/field_class.hpp"

#include <algorithm>
#include <utility>

namespace tracing::ctf {

namespace {

constexpr std::uint64_t kHuge = std::uint64_t{1} << 60;  // more bits than any packet has

std::uint64_t least_bits_of(const FieldClass& type) {
  std::uint64_t bits = 0;
  switch (type.kind) {
    case FieldKind::kInteger:
    case FieldKind::kEnumeration:
    case FieldKind::kReal:
      return type.size;
    case FieldKind::kString:
      return 8;  // its end
    case FieldKind::kStructure:
      for (const FieldMember& member : type.members) {
        bits = std::min(kHuge, bits + member.type->least_bits);
      }
      return bits;
    case FieldKind::kVariant:
      bits = type.members.empty() ? 0 : kHuge;
      for (const FieldMember& option : type.members) {
        bits = std::min(bits, option.type->least_bits);
      }
      return bits;
    case FieldKind::kArray:
      bits = type.element->least_bits;
      return bits != 0 && type.length > kHuge / bits ? kHuge : bits * type.length;
    case FieldKind::kSequence:
      return 0;
  }
  return 0;
}

}  // namespace

FieldClassPtr complete(FieldClass type) {
  type.depth = 1;
  type.fields = 1;
  const auto add = [&type](const FieldClass& inner) {
    type.depth = std::max(type.depth, inner.depth + 1);
    type.fields += inner.fields;
  };
  for (const FieldMember& member : type.members) {
    add(*member.type);
  }
  if (type.element) {
    add(*type.element);
  }
  type.least_bits = least_bits_of(type);
  return std::make_shared<const FieldClass>(std::move(type));
}

}  // namespace tracing::ctf
