// SPDX-License-Identifier: Apache-2.0
// The types of fields that a CTF 1.8 trace declares in its metadata.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tracing::ctf {

enum class FieldKind : std::uint8_t {
  kInteger,
  kEnumeration,  // an integer with labels
  kReal,
  kString,  // bytes up to a NUL
  kStructure,
  kVariant,   // one of its members, which an earlier field selects
  kArray,     // as many elements as the metadata say
  kSequence,  // as many elements as an earlier field says
};

// How a number is read from memory. Only numbers that begin at a byte and have the machine's byte order can be read
// directly.
enum class NumberAccess : std::uint8_t {
  kBits,
  kUnsigned8,
  kUnsigned16,
  kUnsigned32,
  kUnsigned64,
  kSigned8,
  kSigned16,
  kSigned32,
  kSigned64
};

struct FieldClass;
using FieldClassPtr = std::shared_ptr<const FieldClass>;

struct FieldMember {
  std::string name;  // without the underscore that LTTng puts in front
  FieldClassPtr type;
};

struct EnumerationRange {
  std::string label;
  std::int64_t first = 0;  // for unsigned enumerations: the same bits
  std::int64_t last = 0;
};

// One type. `kind` decides which members have a meaning.
struct FieldClass {
  FieldKind kind = FieldKind::kInteger;
  std::uint32_t alignment = 1;  // in bits; counts from the beginning of the packet

  // Numbers.
  std::uint32_t size = 0;  // in bits
  bool is_signed = false;
  bool is_big_endian = false;
  bool is_text = false;  // a character; an array or a sequence of characters is read as a string
  std::uint8_t base = 10;
  NumberAccess access = NumberAccess::kBits;
  std::string clock;                     // the clock whose value the integer is; empty: it is no time
  std::vector<EnumerationRange> ranges;  // of an enumeration

  // A structure's members; a variant's options.
  std::vector<FieldMember> members;

  // Arrays and sequences.
  FieldClassPtr element;
  std::uint64_t length = 0;  // of an array
  std::string path;          // the field that holds a sequence's length or selects a variant's option

  // What complete() finds out.
  std::uint32_t depth = 1;       // levels of types, one inside another
  std::uint64_t fields = 1;      // of the type with all types in it; an array's element counts once
  std::uint64_t least_bits = 0;  // that a field takes; 0 for some, such as a sequence without elements

  bool is_number() const {
    return kind == FieldKind::kInteger || kind == FieldKind::kEnumeration || kind == FieldKind::kReal;
  }
  // An array or a sequence that is read as a string.
  bool is_characters() const {
    return (kind == FieldKind::kArray || kind == FieldKind::kSequence) && element->kind == FieldKind::kInteger &&
           element->is_text && element->size == 8 && element->alignment == 8;
  }
};

// Types with more levels or fields than these are in no trace of a tracer. To read them would take more stack, or more
// time, than there is.
inline constexpr std::uint32_t kMostLevels = 64;
inline constexpr std::uint64_t kMostFields = 1 << 16;

// Each type is made with this function. The types in it are complete already.
FieldClassPtr complete(FieldClass type);

}  // namespace tracing::ctf
