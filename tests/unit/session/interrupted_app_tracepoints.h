// SPDX-License-Identifier: Apache-2.0
// An event of provider ros2 whose payload is told by a function of the program, within_event(). It is called when the
// event has its place in the buffer and is not complete.
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2
#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "interrupted_app_tracepoints.h"

#if !defined(INTERRUPTED_APP_TRACEPOINTS_H) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define INTERRUPTED_APP_TRACEPOINTS_H

#include <lttng/tracepoint.h>

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_take, LTTNG_UST_TP_ARGS(const void*, message_argument),
                           LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, message,
                                                                           within_event(message_argument))))

#endif

#include <lttng/tracepoint-event.h>
