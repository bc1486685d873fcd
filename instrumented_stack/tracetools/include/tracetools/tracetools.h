// SPDX-License-Identifier: Apache-2.0
#pragma once

// Tracepoints of the ROS 2 layers, without a tracer's headers: instrument through the three macros below.
//
//   TRACETOOLS_TRACEPOINT(rcl_take, message);
//
// If computing an argument is expensive, ask first, then record without asking again. Asking twice could record an
// argument that was not prepared:
//
//   if (TRACETOOLS_TRACEPOINT_ENABLED(rmw_publisher_init)) {
//     …
//     TRACETOOLS_DO_TRACEPOINT(rmw_publisher_init, handle, gid);
//   }
//
// The events of provider `ros2_ext` have the same macros with _EXT_ in the name:
// TRACETOOLS_EXT_TRACEPOINT(rcl_node_fini, node).
//
// A tracepoint costs a call, a load and a branch if no session records it. All functions may be called from any
// thread.

#include "tracetools/config.h"

#ifdef TRACETOOLS_DISABLED

#define TRACETOOLS_TRACEPOINT(...) ((void)0)
#define TRACETOOLS_TRACEPOINT_ENABLED(event) false
#define TRACETOOLS_DO_TRACEPOINT(...) ((void)0)
#define TRACETOOLS_EXT_TRACEPOINT(...) ((void)0)
#define TRACETOOLS_EXT_TRACEPOINT_ENABLED(event) false
#define TRACETOOLS_DO_EXT_TRACEPOINT(...) ((void)0)

#else

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tracetools/events.h"
#include "tracetools/events_ext.h"

#define TRACETOOLS_TRACEPOINT(event, ...) ros_trace_##event(__VA_ARGS__)
#define TRACETOOLS_TRACEPOINT_ENABLED(event) ros_trace_enabled_##event()
#define TRACETOOLS_DO_TRACEPOINT(event, ...) ros_trace_do_##event(__VA_ARGS__)
#define TRACETOOLS_EXT_TRACEPOINT(event, ...) ros_trace_ext_##event(__VA_ARGS__)
#define TRACETOOLS_EXT_TRACEPOINT_ENABLED(event) ros_trace_ext_enabled_##event()
#define TRACETOOLS_DO_EXT_TRACEPOINT(event, ...) ros_trace_ext_do_##event(__VA_ARGS__)

#ifdef __cplusplus
extern "C" {
#endif

// Whether the library was built with tracepoints that can record (see TRACETOOLS_TRACEPOINTS_EXCLUDED).
bool ros_trace_compile_status(void);

// Whether the provider is loaded in this process, so that sessions can record events. False with
// TRACETOOLS_RUNTIME_DISABLE=1 in the environment, and if libtracetools_provider.so could not be opened.
bool ros_trace_runtime_status(void);

// Calls bypass the procedure linkage table. While no session records, each cache line that a call touches is a large
// part of its cost.
#if defined(__has_attribute)
#if __has_attribute(noplt)
#define TRACETOOLS_CALLED_DIRECTLY __attribute__((noplt))
#endif
#endif
#ifndef TRACETOOLS_CALLED_DIRECTLY
#define TRACETOOLS_CALLED_DIRECTLY
#endif

// Three functions for each event: record it if it is wanted; tell whether it is wanted; record it without asking.
//
// An event is wanted if a session records it. An init event is always wanted if tracing is enabled at run time: it is
// kept for sessions that start later (see object_state.hpp).
#define TRACETOOLS_DECLARE_FUNCTIONS(prefix, name, parameters)   \
  TRACETOOLS_CALLED_DIRECTLY void prefix##_##name parameters;    \
  TRACETOOLS_CALLED_DIRECTLY bool prefix##_enabled_##name(void); \
  void prefix##_do_##name parameters;
#define TRACETOOLS_DECLARE_EVENT(prefix, name, Struct, group, ...) \
  TRACETOOLS_DECLARE_FUNCTIONS(prefix, name, TRACETOOLS_PARAMETERS(__VA_ARGS__))

TRACETOOLS_EVENT_TABLE(TRACETOOLS_DECLARE_EVENT, ros_trace)
TRACETOOLS_EXT_EVENT_TABLE(TRACETOOLS_DECLARE_EVENT, ros_trace_ext)

#undef TRACETOOLS_DECLARE_EVENT
#undef TRACETOOLS_DECLARE_FUNCTIONS

#ifdef __cplusplus
}
#endif

#endif  // TRACETOOLS_DISABLED
