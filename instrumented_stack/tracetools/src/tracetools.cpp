/// The functions of tracetools.h, one trio per row of events.h, and the definitions of their tracepoints. The probes
/// that write the records are in libtracetools_provider.so: see provider_loader.cpp.
#include "tracetools/tracetools.h"

// Not every function hands on every parameter (rclcpp_publish), and none does when tracepoints are excluded.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#ifdef TRACETOOLS_TRACEPOINTS_EXCLUDED

#define DEFINE_EVENT(name, parameters, arguments) \
  void ros_trace_##name parameters {}             \
  bool ros_trace_enabled_##name(void) {           \
    return false;                                 \
  }                                               \
  void ros_trace_do_##name parameters {}

bool ros_trace_compile_status(void) {
  return false;
}
bool ros_trace_runtime_status(void) {
  return false;
}

#else

#define LTTNG_UST_TRACEPOINT_DEFINE
#define LTTNG_UST_TRACEPOINT_PROBE_DYNAMIC_LINKAGE
#include "provider.h"
#include "provider_loader.hpp"

// The provider's name stands here literally because LTTng's macros paste it before expanding it.
#define RECORD_IF_ENABLED(name, ...) lttng_ust_tracepoint(ros2, name __VA_OPT__(, ) __VA_ARGS__)
#define RECORD(name, ...) lttng_ust_do_tracepoint(ros2, name __VA_OPT__(, ) __VA_ARGS__)
#define WITHOUT_PARENTHESES(...) __VA_ARGS__

#define DEFINE_EVENT(name, parameters, arguments)           \
  void ros_trace_##name parameters {                        \
    RECORD_IF_ENABLED(name, WITHOUT_PARENTHESES arguments); \
  }                                                         \
  bool ros_trace_enabled_##name(void) {                     \
    return lttng_ust_tracepoint_enabled(ros2, name);        \
  }                                                         \
  void ros_trace_do_##name parameters {                     \
    RECORD(name, WITHOUT_PARENTHESES arguments);            \
  }

bool ros_trace_compile_status(void) {
  return true;
}
bool ros_trace_runtime_status(void) {
  return tracetools::provider_is_loaded();
}

#endif

TRACETOOLS_EVENTS(DEFINE_EVENT)
