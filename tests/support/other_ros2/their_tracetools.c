/* SPDX-License-Identifier: Apache-2.0
 * libtracetools.so of another ROS 2: all functions of its version, of which three record unless it is silent. */
#include "their_interface.h"

#ifndef THEIR_SILENCE /* built without LTTng */
#define LTTNG_UST_TRACEPOINT_CREATE_PROBES
#define LTTNG_UST_TRACEPOINT_DEFINE
#include "their_provider.h"
#endif

#pragma GCC diagnostic ignored "-Wunused-parameter"

bool ros_trace_compile_status(void) {
  return true;
}
#if THEIR_VERSION >= 809
bool ros_trace_runtime_status(void) {
  return true;
}
#endif
#ifdef THEIR_UNKNOWN_FUNCTION
void ros_trace_dds_write(const void* message) {}
#endif

/* The others are weak, and take the place of no function that is defined below. */
#if THEIR_VERSION >= 501
#define DEFINE_THEIR_FUNCTION(name, parameters)             \
  __attribute__((weak)) void ros_trace_##name parameters {} \
  bool ros_trace_enabled_##name(void) {                     \
    return true;                                            \
  }                                                         \
  void ros_trace_do_##name parameters {}
#else
#define DEFINE_THEIR_FUNCTION(name, parameters) \
  __attribute__((weak)) void ros_trace_##name parameters {}
#endif
THEIR_FUNCTIONS(DEFINE_THEIR_FUNCTION)
