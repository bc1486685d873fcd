// SPDX-License-Identifier: Apache-2.0
#pragma once

// A function record_<provider>_<event>(arguments that are recorded) for each event. It counts the event and records
// it. For an event of plain fields, that is of numbers and addresses alone, it only hands the payload to the function
// that records for all (recording.hpp), and is so short that it has one line of memory. The payload has the fields as
// LTTng writes them: one after another, without gaps.

#include <lttng/ust-tracer.h>

#include <cstddef>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "counters/event_counters.hpp"
#include "probes/probes.hpp"
#include "provider/provider.h"
#include "provider/provider_ext.h"
#include "recording/fetch_plan.hpp"
#include "recording/recording.hpp"
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
    [[maybe_unused]] std::size_t at = 0;  // some events have no fields
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

// True for an event that is the first one on a message's way. A variable of its own: with UndefinedBehaviorSanitizer
// GCC 12 does not take the comparison of an address with null for a constant.
template <typename Event>
inline constexpr bool has_plan = false;

// The plan of such an event; null for others.
template <typename Event>
inline constexpr FetchPlan* plan_of = nullptr;

inline constinit FetchPlan publications(&lttng_ust_tracepoint_ros2___rcl_publish,
                                        &lttng_ust_tracepoint_ros2___rmw_publish);
template <>
inline constexpr bool has_plan<event::rclcpp_publish> = true;
template <>
inline constexpr FetchPlan* plan_of<event::rclcpp_publish> = &publications;

inline constinit FetchPlan takes(&lttng_ust_tracepoint_ros2___rclcpp_executor_execute,
                                 &lttng_ust_tracepoint_ros2___rmw_take, &lttng_ust_tracepoint_ros2___rcl_take,
                                 &lttng_ust_tracepoint_ros2___rclcpp_take, &lttng_ust_tracepoint_ros2___callback_start);
template <>
inline constexpr bool has_plan<event::rclcpp_executor_get_next_ready> = true;
template <>
inline constexpr FetchPlan* plan_of<event::rclcpp_executor_get_next_ready> = &takes;

}  // namespace tracetools

// Parameters as in tracetools.h, without those that are not recorded.
#define RECORDED_PARAMETER(type, name) RECORDED_PARAMETER_##type(name)
#define RECORDED_PARAMETER_ignored(name)
#define RECORDED_PARAMETER_pointer TRACETOOLS_PARAMETER_pointer
#define RECORDED_PARAMETER_string TRACETOOLS_PARAMETER_string
#define RECORDED_PARAMETER_keyword_string TRACETOOLS_PARAMETER_keyword_string
#define RECORDED_PARAMETER_size TRACETOOLS_PARAMETER_size
#define RECORDED_PARAMETER_uint64 TRACETOOLS_PARAMETER_uint64
#define RECORDED_PARAMETER_int64 TRACETOOLS_PARAMETER_int64
#define RECORDED_PARAMETER_boolean TRACETOOLS_PARAMETER_boolean
#define RECORDED_PARAMETER_gid TRACETOOLS_PARAMETER_gid
#define RECORDED_PARAMETER_pointers TRACETOOLS_PARAMETER_pointers
#define RECORDED_PARAMETER_version TRACETOOLS_PARAMETER_version
#define RECORDED_PARAMETER_nothing TRACETOOLS_PARAMETER_nothing

#define RECORD_FUNCTION(provider, name, Struct, group, ...)                                                         \
  [[gnu::noinline, gnu::aligned(64), gnu::section(".text.hot.record"),                                              \
    maybe_unused]] static void record_##provider##_##name(TRACETOOLS_LIST(TRACETOOLS_EACH_FIELD(RECORDED_PARAMETER, \
                                                                                                __VA_ARGS__))) {    \
    RECORD(provider, name, TRACETOOLS_LIST(TRACETOOLS_EACH_FIELD(TRACETOOLS_ARGUMENT, __VA_ARGS__)))                \
  }
#define RECORD(provider, name, ...)                                                                                  \
  if constexpr (tracetools::is_plain<tracetools::event::name>) {                                                     \
    using Payload = tracetools::PayloadOf<decltype(lttng_ust_tracepoint_cb_##provider##___##name)>::type;            \
    const Payload payload{__VA_ARGS__};                                                                              \
    if constexpr (tracetools::has_plan<tracetools::event::name>) {                                                   \
      tracetools::record_first(lttng_ust_tracepoint_##provider##___##name, tracetools::CountedEvent::name,           \
                               payload.data(), Payload::size(), &Payload::call,                                      \
                               *tracetools::plan_of<tracetools::event::name>);                                       \
    } else {                                                                                                         \
      tracetools::record(lttng_ust_tracepoint_##provider##___##name, tracetools::CountedEvent::name, payload.data(), \
                         Payload::size(), &Payload::call);                                                           \
    }                                                                                                                \
  } else {                                                                                                           \
    tracetools::count(tracetools::CountedEvent::name);                                                               \
    lttng_ust_do_tracepoint(provider, name __VA_OPT__(, ) __VA_ARGS__);                                              \
  }

TRACETOOLS_EVENT_TABLE(RECORD_FUNCTION, ros2)
TRACETOOLS_EXT_EVENT_TABLE(RECORD_FUNCTION, ros2_ext)

#undef RECORD_FUNCTION
#undef RECORD
