// SPDX-License-Identifier: Apache-2.0
// The events of ros2_tracing as structs, one per event, generated from ros2_event_table.hpp.
//
// A field that a trace does not hold (recorded by another version of ros2_tracing) has its zero value, which no
// recorded object or time has. Strings are views into the reader's memory, valid as long as the Event they came from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "tracing/reader/ros2_event_table.hpp"

namespace tracing::ros2 {

enum class FieldType { kPointer, kString, kUint64, kInt64, kBool, kGid, kPointers };

using Handle = std::uint64_t;  // an address in the traced process

// The identity of a DDS endpoint: 16 bytes, 24 before ros2_tracing 8.4.
struct Gid {
  std::array<std::uint8_t, 24> bytes{};
  std::size_t size = 0;  // of bytes that were recorded
  bool operator==(const Gid&) const = default;
};

// The C++ types of the fields, in the order of FieldType.
using FieldMembers = std::tuple<Handle, std::string_view, std::uint64_t, std::int64_t, bool, Gid, std::vector<Handle>>;
template <FieldType type>
using FieldMember = std::tuple_element_t<static_cast<std::size_t>(type), FieldMembers>;

// The name of a field in the trace, from its name in the table.
constexpr std::string_view field_name(std::string_view member) {
  return member.ends_with('_') ? member.substr(0, member.size() - 1) : member;
}

#define TRACING_DECLARE_MEMBER(type_, name_) FieldMember<FieldType::type_> name_{};
#define TRACING_VISIT_MEMBER(type_, name_) visit.template operator()<FieldType::type_>(field_name(#name_), event.name_);

// Each struct has `kName`, the full event name, and `for_each_field(event, visit)`, which calls
// visit.operator()<FieldType>(field name, member) for each member in the order of the payload.
#define TRACING_DECLARE_EVENT(struct_, name_, fields_)                 \
  struct struct_ {                                                     \
    static constexpr std::string_view kName = "ros2:" #name_;          \
    fields_ bool operator==(const struct_&) const = default;           \
    template <class Event, class Visit>                                \
    static constexpr void for_each_field(Event& event, Visit&& visit); \
  };
TRACING_ROS2_EVENTS(TRACING_DECLARE_EVENT, TRACING_DECLARE_MEMBER)
#undef TRACING_DECLARE_EVENT
#undef TRACING_DECLARE_MEMBER

#define TRACING_DEFINE_FOR_EACH_FIELD(struct_, name_, fields_)                                            \
  template <class Event, class Visit>                                                                     \
  constexpr void struct_::for_each_field([[maybe_unused]] Event& event, [[maybe_unused]] Visit&& visit) { \
    fields_                                                                                               \
  }
TRACING_ROS2_EVENTS(TRACING_DEFINE_FOR_EACH_FIELD, TRACING_VISIT_MEMBER)
#undef TRACING_DEFINE_FOR_EACH_FIELD
#undef TRACING_VISIT_MEMBER

#define TRACING_NAME_STRUCT(struct_, name_, fields_) , struct_
#define TRACING_NO_FIELD(type_, name_)
// monostate: nothing decoded yet.
using AnyEvent = std::variant<std::monostate TRACING_ROS2_EVENTS(TRACING_NAME_STRUCT, TRACING_NO_FIELD)>;
#undef TRACING_NO_FIELD
#undef TRACING_NAME_STRUCT

inline constexpr std::size_t kEventCount = std::variant_size_v<AnyEvent> - 1;

}  // namespace tracing::ros2
