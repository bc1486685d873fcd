// SPDX-License-Identifier: Apache-2.0
// The events of ros2_tracing as structs, one per event, from the table that tracetools uses for recording.
//
// A field that a trace does not hold (because another version of ros2_tracing recorded it) has the value zero, which no
// recorded object or time has. Strings are views into the reader's memory; they are valid as long as the Event they
// came from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "tracetools/event_table.h"

namespace tracing::ros2 {

enum class FieldType { kPointer, kString, kUint64, kInt64, kBool, kGid, kPointers };

using Handle = std::uint64_t;  // an address in the traced process

// The identity of a DDS endpoint: 16 bytes, 24 before ros2_tracing 8.4.
struct Gid {
  std::array<std::uint8_t, 24> bytes{};
  std::size_t size = 0;  // number of recorded bytes
  bool operator==(const Gid&) const = default;
};

// The C++ types of the fields, in the order of FieldType.
using FieldMembers = std::tuple<Handle, std::string_view, std::uint64_t, std::int64_t, bool, Gid, std::vector<Handle>>;
template <FieldType type>
using FieldMember = std::tuple_element_t<static_cast<std::size_t>(type), FieldMembers>;

// How the types of fields in the table are read: USE(type, member, name of the field in the trace).
#define TRACING_FIELD_pointer(USE, name_) USE(kPointer, name_, name_)
#define TRACING_FIELD_string(USE, name_) USE(kString, name_, name_)
#define TRACING_FIELD_keyword_string(USE, name_) USE(kString, name_##_, name_)
#define TRACING_FIELD_size(USE, name_) USE(kUint64, name_, name_)
#define TRACING_FIELD_uint64(USE, name_) USE(kUint64, name_, name_)
#define TRACING_FIELD_int64(USE, name_) USE(kInt64, name_, name_)
#define TRACING_FIELD_boolean(USE, name_) USE(kBool, name_, name_)
#define TRACING_FIELD_gid(USE, name_) USE(kGid, name_, name_)
#define TRACING_FIELD_pointers(USE, name_) USE(kPointers, name_, name_)
#define TRACING_FIELD_version(USE, name_) USE(kString, name_, name_)
#define TRACING_FIELD_ignored(USE, name_)
#define TRACING_FIELD_nothing(USE, name_)

#define TRACING_DECLARE_MEMBER(type_, member_, name_) FieldMember<FieldType::type_> member_{};
#define TRACING_VISIT_MEMBER(type_, member_, name_) visit.template operator()<FieldType::type_>(#name_, event.member_);
#define TRACING_DECLARE_FIELD(type_, name_) TRACING_FIELD_##type_(TRACING_DECLARE_MEMBER, name_)
#define TRACING_VISIT_FIELD(type_, name_) TRACING_FIELD_##type_(TRACING_VISIT_MEMBER, name_)

// Each struct has `kName`, the full event name, and `for_each_field(event, visit)`, which calls
// visit.operator()<FieldType>(field name, member) for each member in the order of the payload.
#define TRACING_DECLARE_EVENT(provider_, name_, struct_, group_, ...)  \
  struct struct_ {                                                     \
    static constexpr std::string_view kName = provider_ ":" #name_;    \
    TRACETOOLS_EACH_FIELD(TRACING_DECLARE_FIELD, __VA_ARGS__)          \
    bool operator==(const struct_&) const = default;                   \
    template <class Event, class Visit>                                \
    static constexpr void for_each_field(Event& event, Visit&& visit); \
  };
TRACETOOLS_EVENT_TABLE(TRACING_DECLARE_EVENT, "ros2")
#undef TRACING_DECLARE_EVENT

#define TRACING_DEFINE_FOR_EACH_FIELD(given_, name_, struct_, group_, ...)                                \
  template <class Event, class Visit>                                                                     \
  constexpr void struct_::for_each_field([[maybe_unused]] Event& event, [[maybe_unused]] Visit&& visit) { \
    TRACETOOLS_EACH_FIELD(TRACING_VISIT_FIELD, __VA_ARGS__)                                               \
  }
TRACETOOLS_EVENT_TABLE(TRACING_DEFINE_FOR_EACH_FIELD, )
#undef TRACING_DEFINE_FOR_EACH_FIELD

#define TRACING_NAME_STRUCT(given_, name_, struct_, ...) , struct_
// monostate: nothing decoded yet.
using AnyEvent = std::variant<std::monostate TRACETOOLS_EVENT_TABLE(TRACING_NAME_STRUCT, )>;
#undef TRACING_NAME_STRUCT

inline constexpr std::size_t kEventCount = std::variant_size_v<AnyEvent> - 1;

}  // namespace tracing::ros2
