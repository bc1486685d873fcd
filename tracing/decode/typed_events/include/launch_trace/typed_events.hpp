// SPDX-License-Identifier: Apache-2.0
// Events as structs, from the tables that also make the tracepoints: the providers `ros2`, `ros2_ext` and `launch`.
//
// A field that a trace does not hold (because another version of ros2_tracing recorded it) has the value zero, which no
// recorded object or time has. Strings are views into the reader's memory; they are valid as long as the event that
// they came from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "launch_trace/launch_event_table.h"
#include "tracetools/event_table.h"

namespace launch_trace {

enum class FieldType { kPointer, kString, kUint64, kInt64, kBool, kReal, kGid, kPointers };

using Handle = std::uint64_t;  // an address in the traced process

// The identity of a DDS endpoint: 16 bytes, 24 before ros2_tracing 8.4.
struct Gid {
  std::array<std::uint8_t, 24> bytes{};
  std::size_t size = 0;  // number of recorded bytes
  bool operator==(const Gid&) const = default;
};

// The C++ types of the fields, in the order of FieldType.
using FieldMembers =
    std::tuple<Handle, std::string_view, std::uint64_t, std::int64_t, bool, double, Gid, std::vector<Handle>>;
template <FieldType type>
using FieldMember = std::tuple_element_t<static_cast<std::size_t>(type), FieldMembers>;

// How the types of fields in the table are read: USE(type, member, name of the field in the trace).
#define LAUNCH_TRACE_FIELD_pointer(USE, name_) USE(kPointer, name_, name_)
#define LAUNCH_TRACE_FIELD_string(USE, name_) USE(kString, name_, name_)
#define LAUNCH_TRACE_FIELD_keyword_string(USE, name_) USE(kString, name_##_, name_)
#define LAUNCH_TRACE_FIELD_size(USE, name_) USE(kUint64, name_, name_)
#define LAUNCH_TRACE_FIELD_uint64(USE, name_) USE(kUint64, name_, name_)
#define LAUNCH_TRACE_FIELD_int64(USE, name_) USE(kInt64, name_, name_)
#define LAUNCH_TRACE_FIELD_uint32(USE, name_) USE(kUint64, name_, name_)
#define LAUNCH_TRACE_FIELD_int32(USE, name_) USE(kInt64, name_, name_)
#define LAUNCH_TRACE_FIELD_real(USE, name_) USE(kReal, name_, name_)
#define LAUNCH_TRACE_FIELD_boolean(USE, name_) USE(kBool, name_, name_)
#define LAUNCH_TRACE_FIELD_gid(USE, name_) USE(kGid, name_, name_)
#define LAUNCH_TRACE_FIELD_pointers(USE, name_) USE(kPointers, name_, name_)
#define LAUNCH_TRACE_FIELD_version(USE, name_) USE(kString, name_, name_)
#define LAUNCH_TRACE_FIELD_ignored(USE, name_)
#define LAUNCH_TRACE_FIELD_nothing(USE, name_)

#define LAUNCH_TRACE_DECLARE_MEMBER(type_, member_, name_) FieldMember<FieldType::type_> member_{};
#define LAUNCH_TRACE_VISIT_MEMBER(type_, member_, name_) \
  visit.template operator()<FieldType::type_>(#name_, event.member_);
#define LAUNCH_TRACE_DECLARE_FIELD(type_, name_) LAUNCH_TRACE_FIELD_##type_(LAUNCH_TRACE_DECLARE_MEMBER, name_)
#define LAUNCH_TRACE_VISIT_FIELD(type_, name_) LAUNCH_TRACE_FIELD_##type_(LAUNCH_TRACE_VISIT_MEMBER, name_)

// Each struct has `kName`, the full event name, and `for_each_field(event, visit)`, which calls
// visit.operator()<FieldType>(field name, member) for each member in the order of the payload.
#define LAUNCH_TRACE_DECLARE_EVENT(provider_, name_, struct_, group_, ...) \
  struct struct_ {                                                         \
    static constexpr std::string_view kName = provider_ ":" #name_;        \
    TRACETOOLS_EACH_FIELD(LAUNCH_TRACE_DECLARE_FIELD, __VA_ARGS__)         \
    bool operator==(const struct_&) const = default;                       \
    template <class Fields, class Visitor>                                 \
    static constexpr void for_each_field(Fields& event, Visitor&& visit);  \
  };
#define LAUNCH_TRACE_DEFINE_EACH(given_, name_, struct_, group_, ...)                                        \
  template <class Fields, class Visitor>                                                                     \
  constexpr void struct_::for_each_field([[maybe_unused]] Fields& event, [[maybe_unused]] Visitor&& visit) { \
    TRACETOOLS_EACH_FIELD(LAUNCH_TRACE_VISIT_FIELD, __VA_ARGS__)                                             \
  }

// Each namespace has the events of one provider, and AnyEvent, a variant of them; monostate: nothing decoded yet.
#define LAUNCH_TRACE_NAME_STRUCT(given_, name_, struct_, ...) , struct_
// clang-format off
#define LAUNCH_TRACE_PROVIDER(table_, name_) \
  namespace name_ { \
  table_(LAUNCH_TRACE_DECLARE_EVENT, #name_) \
  table_(LAUNCH_TRACE_DEFINE_EACH, ) \
  using AnyEvent = std::variant<std::monostate table_(LAUNCH_TRACE_NAME_STRUCT, )>; \
  }
// clang-format on
LAUNCH_TRACE_PROVIDER(TRACETOOLS_EVENT_TABLE, ros2)
LAUNCH_TRACE_PROVIDER(TRACETOOLS_EXT_EVENT_TABLE, ros2_ext)
LAUNCH_TRACE_PROVIDER(LAUNCH_EVENT_TABLE, launch)

}  // namespace launch_trace
