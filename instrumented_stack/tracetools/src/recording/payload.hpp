// SPDX-License-Identifier: Apache-2.0
#pragma once

// The fields of an event as LTTng writes them: one after another, without gaps. Only for events whose fields are all
// numbers or addresses.

#include <lttng/ust-tracer.h>

#include <cstddef>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "probes/probes.hpp"
#include "state/init_events.hpp"

namespace tracetools {

// The types of fields of which the payload has the argument itself.
#define TRACETOOLS_IS_PLAIN(type, name) &&TRACETOOLS_IS_PLAIN_##type
#define TRACETOOLS_IS_PLAIN_pointer true
#define TRACETOOLS_IS_PLAIN_size true
#define TRACETOOLS_IS_PLAIN_uint64 true
#define TRACETOOLS_IS_PLAIN_int64 true
#define TRACETOOLS_IS_PLAIN_boolean true
#define TRACETOOLS_IS_PLAIN_ignored true
#define TRACETOOLS_IS_PLAIN_nothing true
#define TRACETOOLS_IS_PLAIN_string false
#define TRACETOOLS_IS_PLAIN_keyword_string false
#define TRACETOOLS_IS_PLAIN_gid false
#define TRACETOOLS_IS_PLAIN_pointers false
#define TRACETOOLS_IS_PLAIN_version false

#ifdef LTTNG_UST_RING_BUFFER_NATURAL_ALIGN
inline constexpr bool kFieldsHaveNoGaps = false;
#else
inline constexpr bool kFieldsHaveNoGaps = true;
#endif

// Whether the payload of an event is a `Payload` of its arguments.
template <typename Event>
inline constexpr bool is_plain = false;
#define TRACETOOLS_PLAIN_EVENT(given, name, Struct, group, ...) \
  template <>                                                   \
  inline constexpr bool is_plain<event::name> =                 \
      kFieldsHaveNoGaps TRACETOOLS_EACH_FIELD(TRACETOOLS_IS_PLAIN, __VA_ARGS__);
TRACETOOLS_EVENT_TABLE(TRACETOOLS_PLAIN_EVENT, )
TRACETOOLS_EXT_EVENT_TABLE(TRACETOOLS_PLAIN_EVENT, )
#undef TRACETOOLS_PLAIN_EVENT

// The parameters are those of the probes: LTTng records a bool as an int.
template <typename... Parameters>
class Payload {
 public:
  explicit Payload(Parameters... values) {
    std::size_t at = 0;
    (..., (std::memcpy(bytes_ + at, &values, sizeof values), at += sizeof values));
  }

  static constexpr std::size_t size() { return (std::size_t{0} + ... + sizeof(Parameters)); }
  const void* data() const { return bytes_; }

  // Calls a probe with the values of a payload.
  static void call(const Probe& probe, const void* payload) {
    std::size_t at = 0;
    [[maybe_unused]] const auto next = [&]<typename Value>(std::type_identity<Value>) {
      Value value;
      std::memcpy(&value, static_cast<const std::byte*>(payload) + at, sizeof value);
      at += sizeof value;
      return value;
    };
    // Braces, because the values of an initialiser list are computed in their order.
    const std::tuple<Parameters...> values{next(std::type_identity<Parameters>())...};
    std::apply(
        [&](Parameters... each) { reinterpret_cast<void (*)(void*, Parameters...)>(probe.func)(probe.data, each...); },
        values);
  }

 private:
  std::byte bytes_[size() + (size() == 0)] = {};
};

// From the function by which LTTng calls all probes of a tracepoint.
template <typename Callback>
struct PayloadOf;
template <typename... Parameters>
struct PayloadOf<void(Parameters...)> {
  using type = Payload<Parameters...>;
};

}  // namespace tracetools
