// SPDX-License-Identifier: Apache-2.0
// Finds the places of the fields of a structure.
//
// A decoder is made once for each structure that the metadata declare. Nearly all structures that tracers write have
// only numbers, strings and arrays of numbers that begin at bytes. A short list of steps finds their fields, and no
// step is needed when all sizes are fixed. A general decoder finds everything else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tracing/decode/ctf/field.hpp"

namespace tracing::ctf {

// The bytes of a packet contradict the metadata or end early.
class DamagedPacket : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The metadata do not describe the packet or an event in it. In a trace that is still being written they may do so
// later.
class UndescribedPacket : public DamagedPacket {
 public:
  using DamagedPacket::DamagedPacket;
};

// Structures that the lengths and variants of later structures may refer to, by the beginning of a path.
struct FieldScope {
  std::string_view path;  // "stream.event.context"
  const Field* structure = nullptr;
};

// Memory for the fields of one event; reset() makes all of it free again.
class FieldArena {
 public:
  Field* allocate(std::size_t count);
  void reset();

 private:
  static constexpr std::size_t kBlock = 1024;
  std::vector<std::unique_ptr<Field[]>> blocks_;
  std::size_t block_ = 0;  // the block in use
  std::size_t used_ = 0;   // the used part of that block
  std::vector<std::unique_ptr<Field[]>> large_;
};

// Decodes a structure of any kind. Returns the field and, in `end`, the bit behind it. Throws DamagedPacket.
Field decode_structure(const FieldClass& structure, const std::uint8_t* packet, std::uint64_t begin,
                       std::uint64_t limit, const std::vector<FieldScope>& scopes, FieldArena& arena,
                       std::uint64_t& end);

class StructureDecoder {
 public:
  // The place of a field, from the first byte of the structure on.
  struct Place {
    std::uint32_t offset = 0;  // bytes
    std::uint32_t length = 0;  // elements of a sequence or an array; bytes of a string
  };

  // Null stands for a structure without fields.
  explicit StructureDecoder(FieldClassPtr structure);

  bool is_simple() const { return is_simple_; }
  std::uint32_t alignment() const { return structure_ ? structure_->alignment : 1; }
  const FieldClass* type() const { return structure_.get(); }
  std::size_t size() const { return structure_ ? structure_->members.size() : 0; }
  // The bytes of a simple structure whose size never differs. Its places are those of fixed_places().
  std::optional<std::uint32_t> fixed_size() const { return fixed_size_; }
  const Place* fixed_places() const { return fixed_places_.data(); }

  // For a simple structure. Fills in size() places. Returns the first byte behind it, or null when it goes beyond
  // `end`.
  const std::uint8_t* decode(const std::uint8_t* begin, const std::uint8_t* end, Place* places) const;

  std::optional<std::size_t> index_of(std::string_view member) const;

 private:
  struct Step {
    enum class Kind : std::uint8_t { kFixed, kString, kSequence };
    Kind kind = Kind::kFixed;
    std::uint32_t first = 0;  // member
    std::uint32_t count = 1;  // members of a fixed step
    std::uint32_t size = 0;   // bytes of a fixed step, or of an element
    std::uint32_t length_member = 0;
  };

  bool make_steps();
  std::optional<std::uint32_t> fixed_bytes(const FieldClass& type) const;

  FieldClassPtr structure_;
  bool is_simple_ = true;
  std::optional<std::uint32_t> fixed_size_;
  std::vector<Place> fixed_places_;  // of members in fixed steps, from the beginning of the step
  std::vector<Step> steps_;
};

}  // namespace tracing::ctf
