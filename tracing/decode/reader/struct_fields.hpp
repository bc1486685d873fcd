// SPDX-License-Identifier: Apache-2.0
// Reads the fields of an event into the struct of launch_trace/typed_events.hpp that stands for it.
//
// The fields are found by their names, once for each event class, because versions of ros2_tracing have different ones.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "launch_trace/typed_events.hpp"
#include "tracing/decode/reader/event.hpp"

namespace tracing {

using launch_trace::FieldType;

inline constexpr std::uint8_t kMissingField = 0xff;

// Returns false, and leaves the member alone, when the recorded field has another type.
template <FieldType type, class Member>
bool read_field(FieldValue field, Member& member) {
  if constexpr (type == FieldType::kPointer || type == FieldType::kUint64) {
    const std::optional<std::uint64_t> value = field.unsigned_integer();
    if (value) {
      member = *value;
    }
    return value.has_value();
  } else if constexpr (type == FieldType::kInt64) {
    const std::optional<std::int64_t> value = field.integer();
    if (value) {
      member = *value;
    }
    return value.has_value();
  } else if constexpr (type == FieldType::kBool) {
    const std::optional<std::int64_t> value = field.integer();
    if (value) {
      member = *value != 0;
    }
    return value.has_value();
  } else if constexpr (type == FieldType::kReal) {
    const std::optional<double> value = field.real();
    if (value) {
      member = *value;
    }
    return value.has_value();
  } else if constexpr (type == FieldType::kString) {
    const std::optional<std::string_view> value = field.string();
    if (value) {
      member = *value;
    }
    return value.has_value();
  } else if constexpr (type == FieldType::kGid) {
    member.size = std::min(field.size(), member.bytes.size());
    for (std::size_t i = 0; i < member.size; ++i) {
      member.bytes[i] = static_cast<std::uint8_t>(field[i].unsigned_integer().value_or(0));
    }
    return field.is_array();
  } else {
    static_assert(type == FieldType::kPointers);
    member.resize(field.size());
    for (std::size_t i = 0; i < member.size(); ++i) {
      member[i] = field[i].unsigned_integer().value_or(0);
    }
    return field.is_array();
  }
}

constexpr std::string_view type_name(FieldType type) {
  switch (type) {
    case FieldType::kPointer:
      return "a pointer";
    case FieldType::kString:
      return "a string";
    case FieldType::kUint64:
      return "an unsigned integer";
    case FieldType::kInt64:
      return "an integer";
    case FieldType::kBool:
      return "a boolean";
    case FieldType::kReal:
      return "a real number";
    case FieldType::kGid:
      return "an array of bytes";
    case FieldType::kPointers:
      return "a sequence of pointers";
  }
  return "";
}

// Where an event class has a field of a struct.
struct FieldPlace {
  std::uint8_t index = kMissingField;  // in the recorded payload
  // A number that has the same place in all events of the class is read from there. kBits: it is no such number.
  ctf::NumberAccess access = ctf::NumberAccess::kBits;
  std::uint32_t offset = 0;  // bytes from the beginning of the payload
};

constexpr bool is_read_as_number(FieldType type) {
  return type == FieldType::kPointer || type == FieldType::kUint64 || type == FieldType::kInt64 ||
         type == FieldType::kBool;
}

template <FieldType type>
FieldPlace place_of(const Event& event, std::size_t index) {
  FieldPlace place{.index = static_cast<std::uint8_t>(index)};
  if (!is_read_as_number(type) || event.record == nullptr || event.record->places == nullptr ||
      !event.record->decoder->fixed_size()) {
    return place;
  }
  const ctf::NumberAccess access = event.record->decoder->type()->members[index].type->access;
  // Of the largest unsigned numbers an integer is not read.
  const bool may_not_fit = access == ctf::NumberAccess::kUnsigned64;
  if (may_not_fit && (type == FieldType::kInt64 || type == FieldType::kBool)) {
    return place;
  }
  place.access = access;
  place.offset = event.record->places[index].offset;
  return place;
}

// The places of the struct's fields in their order; kMissingField for one that is not there or has another type. Calls
// `report` for each of the latter.
template <class Struct, class Report>
std::vector<FieldPlace> field_places(const Event& event, Report report) {
  std::vector<FieldPlace> places;
  Struct example;
  Struct::for_each_field(example, [&]<FieldType type>(std::string_view name, auto& member) {
    const std::optional<std::size_t> found = event.event_class->index_of(name);
    if (found && *found < kMissingField && read_field<type>(event.field(*found), member)) {
      places.push_back(place_of<type>(event, *found));
      return;
    }
    places.emplace_back();
    report(found ? fmt::format("{}: field {} is not {}", Struct::kName, name, type_name(type))
                 : fmt::format("{} has no field {}", Struct::kName, name));
  });
  return places;
}

template <class Struct>
void read_fields(const Event& event, const std::vector<FieldPlace>& places, Struct& fields) {
  const FieldPlace* next = places.data();
  Struct::for_each_field(fields, [&]<FieldType type>(std::string_view, auto& member) {
    const FieldPlace& place = *next++;
    if constexpr (is_read_as_number(type)) {
      if (place.access != ctf::NumberAccess::kBits) {
        std::uint64_t number = 0;
        if (place.access == ctf::NumberAccess::kUnsigned64) [[likely]] {  // pointers and most numbers
          std::memcpy(&number, event.record->base + place.offset, sizeof number);
        } else {
          number = ctf::load_number(event.record->base + place.offset, place.access);
        }
        if constexpr (type == FieldType::kBool) {
          member = number != 0;
        } else {
          member = static_cast<std::decay_t<decltype(member)>>(number);
        }
        return;
      }
    }
    if (place.index != kMissingField) {
      read_field<type>(event.field(place.index), member);
    }
  });
}

}  // namespace tracing
