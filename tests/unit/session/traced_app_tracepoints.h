// SPDX-License-Identifier: Apache-2.0
// Two events of provider ros2, declared as in tracetools: enough for a program to be traced.
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2
#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "traced_app_tracepoints.h"

#if !defined(TRACED_APP_TRACEPOINTS_H) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define TRACED_APP_TRACEPOINTS_H

#include <lttng/tracepoint.h>

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_init, LTTNG_UST_TP_ARGS(const void*, context, const char*, version_text),
                           LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, context_handle, context)
                                                   lttng_ust_field_string(version, version_text)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_callback_register,
                           LTTNG_UST_TP_ARGS(const void*, callback_address, const char*, symbol_text),
                           LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, callback, callback_address)
                                                   lttng_ust_field_string(symbol, symbol_text)))

#endif

#include <lttng/tracepoint-event.h>
