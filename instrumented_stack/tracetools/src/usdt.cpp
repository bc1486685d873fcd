// SPDX-License-Identifier: Apache-2.0
// The functions of tracetools.h for tools that probe programs in user space. Each event is an SDT note of this library
// (`readelf -n`), which perf, bpftrace and SystemTap see. An unused probe is one `nop`.
//
// The arguments of a probe are those of the C function. Such tools start sessions without the process noticing, so
// there is no state dump.
#include "tracetools/tracetools.h"

// A counter per probe, which the tools raise while they use it. The functions ..._enabled_... read it.
#define _SDT_HAS_SEMAPHORES 1
#define SDT_USE_VARIADIC
#include <sys/sdt.h>

// rclcpp_publish has a parameter that is not recorded.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define WITHOUT_PARENTHESES(...) __VA_ARGS__
#define PROBE(provider, name, ...) STAP_PROBEV(provider, name __VA_OPT__(, ) __VA_ARGS__)

#define DEFINE_FUNCTIONS(provider, prefix, name, parameters, ...)                  \
  extern "C" {                                                                     \
  __extension__ unsigned short provider##_##name##_semaphore                       \
      __attribute__((unused, section(".probes"), visibility("hidden"))) = 0;       \
  void prefix##_do_##name parameters {                                             \
    PROBE(provider, name __VA_OPT__(, ) __VA_ARGS__);                              \
  }                                                                                \
  bool prefix##_enabled_##name(void) {                                             \
    return __atomic_load_n(&provider##_##name##_semaphore, __ATOMIC_RELAXED) != 0; \
  }                                                                                \
  void prefix##_##name parameters {                                                \
    PROBE(provider, name __VA_OPT__(, ) __VA_ARGS__);                              \
  }                                                                                \
  }
#define DEFINE_EVENT(name, parameters, arguments) \
  DEFINE_FUNCTIONS(ros2, ros_trace, name, parameters, WITHOUT_PARENTHESES arguments)
#define DEFINE_EXT_EVENT(name, parameters, arguments) \
  DEFINE_FUNCTIONS(ros2_ext, ros_trace_ext, name, parameters, WITHOUT_PARENTHESES arguments)

bool ros_trace_compile_status(void) {
  return true;
}
bool ros_trace_runtime_status(void) {
  return true;
}

TRACETOOLS_EVENTS(DEFINE_EVENT)
TRACETOOLS_EXT_EVENTS(DEFINE_EXT_EVENT)
