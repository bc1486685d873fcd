// SPDX-License-Identifier: Apache-2.0
// The functions of tracetools.h, one trio per row of events.h and events_ext.h, and the definitions of their
// tracepoints. The probes that write the records are in libtracetools_provider.so: see provider_loader.cpp.
#include "tracetools/tracetools.h"

// Some functions do not pass on every parameter (rclcpp_publish). Without tracepoints none does.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#ifdef TRACETOOLS_TRACEPOINTS_EXCLUDED

#define DEFINE_FUNCTIONS(prefix, name, parameters) \
  void prefix##_##name parameters {}               \
  bool prefix##_enabled_##name(void) {             \
    return false;                                  \
  }                                                \
  void prefix##_do_##name parameters {}

#define DEFINE_EVENT(name, parameters, arguments) DEFINE_FUNCTIONS(ros_trace, name, parameters)
#define DEFINE_EXT_EVENT(name, parameters, arguments) DEFINE_FUNCTIONS(ros_trace_ext, name, parameters)

bool ros_trace_compile_status(void) {
  return false;
}
bool ros_trace_runtime_status(void) {
  return false;
}

#else

// The tracepoints are defined here. These macros must come before any header of LTTng.
#define LTTNG_UST_TRACEPOINT_DEFINE
#define LTTNG_UST_TRACEPOINT_PROBE_DYNAMIC_LINKAGE
#include "counters/event_counters.hpp"
#include "deadline.hpp"
#include "provider/provider.h"
#include "provider/provider_ext.h"
#include "provider/provider_session.h"
#include "provider_loader.hpp"
#include "recording/record_functions.hpp"
#include "state/init_events.hpp"

#define WITHOUT_PARENTHESES(...) __VA_ARGS__

// For sessions that start late. Does nothing if no session can start.
#define KEEP(provider, name, ...)                                                                                     \
  if (tracetools::is_traceable()) {                                                                                   \
    tracetools::keep<tracetools::event::name>(#name, TRACETOOLS_RECORDER(provider, name) __VA_OPT__(, ) __VA_ARGS__); \
  }
#define NOTE(name, ...)                                                                                           \
  if constexpr (tracetools::is_noted<tracetools::event::name>) {                                                  \
    if (tracetools::is_traceable()) {                                                                             \
      tracetools::note<tracetools::event::name>(TRACETOOLS_RECORDER(ros2_ext, rcl_lifecycle_state) __VA_OPT__(, ) \
                                                    __VA_ARGS__);                                                 \
    }                                                                                                             \
  }

// Deadlines are watched whether or not a session records.
namespace {
template <typename Event>
inline bool is_watched() {
  using namespace tracetools;
  if constexpr (std::is_same_v<Event, event::callback_start> || std::is_same_v<Event, event::callback_end>) {
    return watches_callbacks();
  } else if constexpr (std::is_same_v<Event, event::rmw_take> || std::is_same_v<Event, event::rcl_take>) {
    return watches_messages();
  } else {
    return false;
  }
}

template <typename Event, typename... Arguments>
inline void watch(Arguments...) {}
template <>
inline void watch<tracetools::event::callback_start>(const void*, bool) {
  tracetools::callback_starts();
}
template <>
inline void watch<tracetools::event::callback_end>(const void* callback) {
  tracetools::callback_ends(callback);
}
template <>
inline void watch<tracetools::event::rmw_take>(const void* handle, const void* message, std::int64_t source_timestamp,
                                               bool taken) {
  tracetools::message_taken(handle, message, source_timestamp, taken);
}
template <>
inline void watch<tracetools::event::rcl_take>(const void* message) {
  tracetools::message_handed_on(message);
}

// The state of each tracepoint is in its own cache line, which has been evicted by the time a message comes. The first
// tracepoint that a message passes prefetches the following ones, all at once.
template <typename Event>
inline void fetch_followers() {}
template <>
inline void fetch_followers<tracetools::event::rclcpp_publish>() {
  __builtin_prefetch(&lttng_ust_tracepoint_ros2___rcl_publish.state);
  __builtin_prefetch(&lttng_ust_tracepoint_ros2___rmw_publish.state);
}
template <>
inline void fetch_followers<tracetools::event::rclcpp_executor_get_next_ready>() {
  __builtin_prefetch(&lttng_ust_tracepoint_ros2___rclcpp_executor_execute.state);
  __builtin_prefetch(&lttng_ust_tracepoint_ros2___rmw_take.state);
  __builtin_prefetch(&lttng_ust_tracepoint_ros2___rcl_take.state);
  __builtin_prefetch(&lttng_ust_tracepoint_ros2___rclcpp_take.state);
  __builtin_prefetch(&lttng_ust_tracepoint_ros2___callback_start.state);
}
}  // namespace

#define IS_WANTED(name, enabled) \
  (enabled) || (tracetools::is_init_event<tracetools::event::name> && tracetools::is_traceable())

// Usually no session records, and the code of these functions is no longer in the processor's caches when a message
// comes. So the check takes a few instructions in each, side by side, and the recording code is kept apart
// (record_functions.hpp).
#define RECORD_IF_WANTED(provider, name, arguments)          \
  if (is_watched<tracetools::event::name>()) {               \
    watched_##provider##_##name arguments;                   \
  } else if (lttng_ust_tracepoint_enabled(provider, name)) { \
    record_##provider##_##name arguments;                    \
  }
#define DEFINE_FUNCTIONS(prefix, provider, name, parameters, arguments)            \
  template <typename... Arguments>                                                 \
  [[gnu::noinline]] static void watched_##provider##_##name(Arguments... values) { \
    if (lttng_ust_tracepoint_enabled(provider, name))                              \
      record_##provider##_##name(values...);                                       \
    watch<tracetools::event::name>(values...);                                     \
  }                                                                                \
  [[gnu::hot]] void prefix##_##name parameters {                                   \
    if constexpr (tracetools::is_init_event<tracetools::event::name>) {            \
      KEEP(provider, name, WITHOUT_PARENTHESES arguments)                          \
    } else {                                                                       \
      NOTE(name, WITHOUT_PARENTHESES arguments)                                    \
      fetch_followers<tracetools::event::name>();                                  \
      RECORD_IF_WANTED(provider, name, arguments)                                  \
    }                                                                              \
  }                                                                                \
  bool prefix##_enabled_##name(void) {                                             \
    return IS_WANTED(name, lttng_ust_tracepoint_enabled(provider, name));          \
  }                                                                                \
  void prefix##_do_##name parameters {                                             \
    if constexpr (tracetools::is_init_event<tracetools::event::name>) {            \
      KEEP(provider, name, WITHOUT_PARENTHESES arguments)                          \
    } else {                                                                       \
      NOTE(name, WITHOUT_PARENTHESES arguments)                                    \
      RECORD_IF_WANTED(provider, name, arguments)                                  \
    }                                                                              \
  }

#define DEFINE_EVENT(name, parameters, arguments) DEFINE_FUNCTIONS(ros_trace, ros2, name, parameters, arguments)
#define DEFINE_EXT_EVENT(name, parameters, arguments) \
  DEFINE_FUNCTIONS(ros_trace_ext, ros2_ext, name, parameters, arguments)

bool ros_trace_compile_status(void) {
  return true;
}
bool ros_trace_runtime_status(void) {
  return tracetools::is_traceable();
}

#endif

TRACETOOLS_EVENTS(DEFINE_EVENT)
TRACETOOLS_EXT_EVENTS(DEFINE_EXT_EVENT)
