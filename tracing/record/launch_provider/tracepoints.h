// SPDX-License-Identifier: Apache-2.0
// The payload of every event of provider `launch`, from launch_trace/launch_event_table.h.
//
// LTTng reads this file several times with different definitions of its macros, hence the unusual guards.
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER launch

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "tracepoints.h"

#if !defined(LAUNCH_PROVIDER_TRACEPOINTS_H) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define LAUNCH_PROVIDER_TRACEPOINTS_H

#include <lttng/tracepoint.h>
#include <stdint.h>

#include "launch_trace/launch_event_table.h"
#include "tracetools/event_table.h"

// Arguments and fields have different names, because LTTng's macros would confuse an argument with its field.
// clang-format off
#define LAUNCH_PROBE(provider, name, Struct, group, ...) \
  LTTNG_UST_TRACEPOINT_EVENT(provider, name, \
    LTTNG_UST_TP_ARGS(LAUNCH_LIST(TRACETOOLS_EACH_FIELD(LAUNCH_ARGUMENT, __VA_ARGS__))), \
    LTTNG_UST_TP_FIELDS(TRACETOOLS_EACH_FIELD(LAUNCH_FIELD, __VA_ARGS__)))
// Each argument adds a comma before itself. A list drops the first comma.
#define LAUNCH_LIST(...) LAUNCH_AFTER_FIRST_COMMA(__VA_ARGS__)
#define LAUNCH_AFTER_FIRST_COMMA(nothing, ...) __VA_ARGS__

#define LAUNCH_ARGUMENT(type, name) LAUNCH_ARGUMENT_##type(name##_arg)
#define LAUNCH_ARGUMENT_string(argument) , const char *, argument
#define LAUNCH_ARGUMENT_int32(argument) , int32_t, argument
#define LAUNCH_ARGUMENT_uint32(argument) , uint32_t, argument
#define LAUNCH_ARGUMENT_int64(argument) , int64_t, argument
#define LAUNCH_ARGUMENT_uint64(argument) , uint64_t, argument
#define LAUNCH_ARGUMENT_real(argument) , double, argument

#define LAUNCH_FIELD(type, name) LAUNCH_FIELD_##type(name)
#define LAUNCH_FIELD_string(name) lttng_ust_field_string(name, name##_arg)
#define LAUNCH_FIELD_int32(name) lttng_ust_field_integer(int32_t, name, name##_arg)
#define LAUNCH_FIELD_uint32(name) lttng_ust_field_integer(uint32_t, name, name##_arg)
#define LAUNCH_FIELD_int64(name) lttng_ust_field_integer(int64_t, name, name##_arg)
#define LAUNCH_FIELD_uint64(name) lttng_ust_field_integer(uint64_t, name, name##_arg)
#define LAUNCH_FIELD_real(name) lttng_ust_field_float(double, name, name##_arg)
// clang-format on

LAUNCH_EVENT_TABLE(LAUNCH_PROBE, launch)

#endif

#include <lttng/tracepoint-event.h>
