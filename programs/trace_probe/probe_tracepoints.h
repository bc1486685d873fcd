// SPDX-License-Identifier: Apache-2.0
// The events of launch-trace-probe.
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER launch_probe

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "probe_tracepoints.h"

#if !defined(LAUNCH_PROBE_TRACEPOINTS_H) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define LAUNCH_PROBE_TRACEPOINTS_H

#include <lttng/tracepoint.h>

LTTNG_UST_TRACEPOINT_EVENT(launch_probe, fired, LTTNG_UST_TP_ARGS(void), LTTNG_UST_TP_FIELDS())

// Has the same fields as rcl_publish and most events that come often.
LTTNG_UST_TRACEPOINT_EVENT(launch_probe, measured,
                           LTTNG_UST_TP_ARGS(const void*, handle_argument, const void*, message_argument),
                           LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, handle, handle_argument)
                                                   lttng_ust_field_integer_hex(const void*, message, message_argument)))

#endif

#include <lttng/tracepoint-event.h>
