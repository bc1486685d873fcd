// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/structure_decoder.hpp"

#include <algorithm>
#include <cstring>

namespace tracing::ctf {
namespace {

constexpr std::uint32_t kByte = 8;  // bits

const FieldMember* member_named(const FieldClass& structure, std::string_view name) {
  for (const FieldMember& member : structure.members) {
    if (member.name == name) {
      return &member;
    }
  }
  return nullptr;
}

}  // namespace

StructureDecoder::StructureDecoder(FieldClassPtr structure) : structure_(std::move(structure)) {
  is_simple_ = !structure_ || make_steps();
  if (!is_simple_) {
    return;
  }
  if (steps_.empty()) {
    fixed_size_ = 0;
  } else if (steps_.size() == 1 && steps_[0].kind == Step::Kind::kFixed) {
    fixed_size_ = steps_[0].size;
  }
}

// The size in bytes of a type that always has the same size and can begin at any byte.
std::optional<std::uint32_t> StructureDecoder::fixed_bytes(const FieldClass& type) const {
  if (type.alignment > kByte) {
    return std::nullopt;
  }
  if (type.is_number() && type.size % kByte == 0 && type.alignment == kByte) {
    return type.size / kByte;
  }
  if (type.kind == FieldKind::kArray && type.element->is_number()) {
    if (const auto element = fixed_bytes(*type.element); element && type.length < (1U << 20)) {
      return *element * static_cast<std::uint32_t>(type.length);
    }
  }
  return std::nullopt;
}

bool StructureDecoder::make_steps() {
  const std::vector<FieldMember>& members = structure_->members;
  if (!members.empty() && structure_->alignment != kByte) {
    return false;
  }
  fixed_places_.resize(members.size());
  for (std::uint32_t i = 0; i < members.size(); ++i) {
    const FieldClass& type = *members[i].type;
    if (const auto bytes = fixed_bytes(type)) {
      if (steps_.empty() || steps_.back().kind != Step::Kind::kFixed) {
        steps_.push_back({Step::Kind::kFixed, i, 0, 0, 0});
      }
      Step& step = steps_.back();
      fixed_places_[i] = {step.size, static_cast<std::uint32_t>(type.length)};
      step.size += *bytes;
      ++step.count;
    } else if (type.kind == FieldKind::kString) {
      steps_.push_back({Step::Kind::kString, i, 1, 0, 0});
    } else if (type.kind == FieldKind::kSequence && type.element->is_number()) {
      const auto element = fixed_bytes(*type.element);
      // The nearest earlier member of that name has the length.
      std::uint32_t length_member = i;
      while (length_member-- > 0 && members[length_member].name != type.path) {
      }
      if (!element || length_member >= i || members[length_member].type->kind != FieldKind::kInteger) {
        return false;
      }
      steps_.push_back({Step::Kind::kSequence, i, 1, *element, length_member});
    } else {
      return false;
    }
  }
  return true;
}

const std::uint8_t* StructureDecoder::decode(const std::uint8_t* begin, const std::uint8_t* end, Place* places) const {
  const std::uint8_t* at = begin;
  for (const Step& step : steps_) {
    const auto offset = static_cast<std::uint32_t>(at - begin);
    const auto left = static_cast<std::size_t>(end - at);
    switch (step.kind) {
      case Step::Kind::kFixed:
        if (step.size > left) {
          return nullptr;
        }
        for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
          places[i] = {offset + fixed_places_[i].offset, fixed_places_[i].length};
        }
        at += step.size;
        break;
      case Step::Kind::kString: {
        const void* const nul = std::memchr(at, 0, left);
        if (nul == nullptr) {
          return nullptr;
        }
        const auto length = static_cast<std::uint32_t>(static_cast<const std::uint8_t*>(nul) - at);
        places[step.first] = {offset, length};
        at += length + 1;
        break;
      }
      case Step::Kind::kSequence: {
        const Field length{structure_->members[step.length_member].type.get(), begin,
                           std::uint64_t{places[step.length_member].offset} * kByte, 0, nullptr};
        const std::uint64_t count = length.raw();
        if (count > left || count * step.size > left) {
          return nullptr;
        }
        places[step.first] = {offset, static_cast<std::uint32_t>(count)};
        at += count * step.size;
        break;
      }
    }
  }
  return at;
}

std::optional<std::size_t> StructureDecoder::index_of(std::string_view member) const {
  if (!structure_) {
    return std::nullopt;
  }
  const FieldMember* const found = member_named(*structure_, member);
  if (found == nullptr) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - structure_->members.data());
}

Field* FieldArena::allocate(std::size_t count) {
  if (count > kBlock) {
    return large_.emplace_back(std::make_unique<Field[]>(count)).get();
  }
  if (blocks_.empty() || used_ + count > kBlock) {
    if (!blocks_.empty()) {
      ++block_;
    }
    if (block_ == blocks_.size()) {
      blocks_.push_back(std::make_unique<Field[]>(kBlock));
    }
    used_ = 0;
  }
  Field* const allocated = &blocks_[block_][used_];
  used_ += count;
  return allocated;
}

void FieldArena::reset() {
  block_ = used_ = 0;
  large_.clear();
}

namespace {

class GeneralDecoder {
 public:
  GeneralDecoder(const std::uint8_t* packet, std::uint64_t begin, std::uint64_t limit,
                 const std::vector<FieldScope>& scopes, FieldArena& arena)
      : packet_(packet), at_(begin), limit_(limit), scopes_(scopes), arena_(arena) {}

  Field decode(const FieldClass& type) {
    align(type.alignment);
    switch (type.kind) {
      case FieldKind::kInteger:
      case FieldKind::kEnumeration:
      case FieldKind::kReal:
        return number(type);
      case FieldKind::kString:
        return string(type);
      case FieldKind::kStructure:
        return structure(type);
      case FieldKind::kVariant:
        return variant(type);
      case FieldKind::kArray:
        return elements(type, type.length);
      case FieldKind::kSequence:
        return elements(type, find(type.path).raw());
    }
    throw UnsupportedKind();
  }

  std::uint64_t at() const { return at_; }

 private:
  struct UnsupportedKind : DamagedPacket {
    UnsupportedKind() : DamagedPacket("a field of an unknown kind") {}
  };
  // A structure whose members are being decoded.
  struct Open {
    const FieldClass* type;
    const Field* members;
    std::size_t count;
    const Open* outer;
  };

  void align(std::uint32_t alignment) { at_ = (at_ + alignment - 1) / alignment * alignment; }
  void advance(std::uint64_t bits) {
    if (bits > limit_ || at_ > limit_ - bits) {
      throw DamagedPacket("an event goes beyond the end of its packet");
    }
    at_ += bits;
  }

  Field number(const FieldClass& type) {
    const Field field{&type, packet_, at_, 0, nullptr};
    advance(type.size);
    return field;
  }

  Field string(const FieldClass& type) {
    const std::uint8_t* const bytes = packet_ + at_ / kByte;
    const std::size_t left = at_ < limit_ ? (limit_ - at_) / kByte : 0;
    const void* const nul = left > 0 ? std::memchr(bytes, 0, left) : nullptr;
    if (nul == nullptr) {
      throw DamagedPacket("a string goes beyond the end of its packet");
    }
    const auto length = static_cast<std::uint64_t>(static_cast<const std::uint8_t*>(nul) - bytes);
    const Field field{&type, packet_, at_, length, nullptr};
    advance((length + 1) * kByte);
    return field;
  }

  Field structure(const FieldClass& type) {
    Field field{&type, packet_, at_, type.members.size(), nullptr};
    Field* const members = arena_.allocate(type.members.size());
    field.children = members;
    Open open{&type, members, 0, open_};
    open_ = &open;
    for (; open.count < type.members.size(); ++open.count) {
      members[open.count] = decode(*type.members[open.count].type);
    }
    open_ = open.outer;
    return field;
  }

  Field variant(const FieldClass& type) {
    const std::string_view label = find(type.path).label();
    const FieldMember* option = member_named(type, label);
    if (option == nullptr && label.starts_with('_')) {
      option = member_named(type, label.substr(1));
    }
    if (option == nullptr) {
      throw DamagedPacket("a variant has no option for its selector");
    }
    Field* const chosen = arena_.allocate(1);
    Field field{&type, packet_, at_, 1, chosen};
    *chosen = decode(*option->type);
    return field;
  }

  Field elements(const FieldClass& type, std::uint64_t count) {
    Field field{&type, packet_, at_, count, nullptr};
    const FieldClass& element = *type.element;
    if (count > limit_) {
      throw DamagedPacket("an array goes beyond the end of its packet");
    }
    if (element.is_number()) {
      const std::uint64_t step = (element.size + element.alignment - 1) / element.alignment * element.alignment;
      if (count > 0) {
        advance((count - 1) * step + element.size);
      }
      return field;
    }
    check_count(element, count);
    Field* const elements = arena_.allocate(count);
    field.children = elements;
    for (std::uint64_t i = 0; i < count; ++i) {
      elements[i] = decode(element);
    }
    return field;
  }

  // A damaged count must not allocate more fields than the rest of the packet can hold.
  void check_count(const FieldClass& element, std::uint64_t count) {
    const std::uint64_t bits = element.least_bits;
    if (count > 0 && bits > 0 && (at_ > limit_ || count > (limit_ - at_) / bits)) {
      throw DamagedPacket("an array goes beyond the end of its packet");
    }
    std::uint64_t& left = bits == 0 ? empty_left_ : elements_left_;
    if (count > left) {
      throw DamagedPacket("an array has too many elements");
    }
    left -= count;
  }

  // The field that a path names: a member of the structures around, the innermost first, or a path from a scope.
  Field find(std::string_view path) const {
    const std::size_t dot = path.find('.');
    const std::string_view first = path.substr(0, dot);
    for (const Open* open = open_; open != nullptr; open = open->outer) {
      for (std::size_t i = open->count; i-- > 0;) {
        if (open->type->members[i].name == first) {
          return inside(open->members[i], path.substr(first.size()));
        }
      }
    }
    for (const FieldScope& scope : scopes_) {
      if (scope.structure == nullptr) {
        continue;
      }
      if (path.starts_with(scope.path) && path.substr(scope.path.size()).starts_with('.')) {
        return inside(*scope.structure, path.substr(scope.path.size()));
      }
    }
    throw DamagedPacket("the length of a sequence or the selector of a variant is not there: " + std::string(path));
  }

  // `path` is empty or begins with a dot.
  static Field inside(Field field, std::string_view path) {
    while (!path.empty()) {
      path.remove_prefix(1);
      const std::string_view name = path.substr(0, path.find('.'));
      const FieldMember* const member =
          field.type->kind == FieldKind::kStructure ? member_named(*field.type, name) : nullptr;
      if (member == nullptr) {
        throw DamagedPacket("there is no field " + std::string(name));
      }
      field = field.children[member - field.type->members.data()];
      path.remove_prefix(name.size());
    }
    return field;
  }

  const std::uint8_t* packet_;
  std::uint64_t at_;     // bits
  std::uint64_t limit_;  // bits
  const std::vector<FieldScope>& scopes_;
  FieldArena& arena_;
  const Open* open_ = nullptr;
  // How many more elements of structures, arrays and strings the fields may have, and how many that may take no bits.
  std::uint64_t elements_left_ = 1 << 20;
  std::uint64_t empty_left_ = 1 << 10;
};

}  // namespace

Field decode_structure(const FieldClass& structure, const std::uint8_t* packet, std::uint64_t begin,
                       std::uint64_t limit, const std::vector<FieldScope>& scopes, FieldArena& arena,
                       std::uint64_t& end) {
  GeneralDecoder decoder(packet, begin, limit, scopes, arena);
  const Field field = decoder.decode(structure);
  end = decoder.at();
  return field;
}

}  // namespace tracing::ctf
