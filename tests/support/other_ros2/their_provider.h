/* SPDX-License-Identifier: Apache-2.0
 * Some of the events that their tracetools records. LTTng reads this file several times, hence the unusual guards. */
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "their_provider.h"

#if !defined(THEIR_PROVIDER_H_) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define THEIR_PROVIDER_H_

#include <lttng/tracepoint.h>
#include <stdint.h>

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_init, LTTNG_UST_TP_ARGS(const void*, context_handle_arg),
                           LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, context_handle,
                                                                           context_handle_arg)
                                                   lttng_ust_field_string(version, THEIR_VERSION_TEXT)))
LTTNG_UST_TRACEPOINT_EVENT(ros2, callback_end, LTTNG_UST_TP_ARGS(const void*, callback_arg),
                           LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, callback, callback_arg)))
#if THEIR_VERSION >= 801
LTTNG_UST_TRACEPOINT_EVENT(
    ros2, rmw_publish,
    LTTNG_UST_TP_ARGS(const void*, rmw_publisher_handle_arg, const void*, message_arg, int64_t, timestamp_arg),
    LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, rmw_publisher_handle, rmw_publisher_handle_arg)
                            lttng_ust_field_integer_hex(const void*, message, message_arg)
                                lttng_ust_field_integer(int64_t, timestamp, timestamp_arg)))
#else
LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_publish, LTTNG_UST_TP_ARGS(const void*, message_arg),
                           LTTNG_UST_TP_FIELDS(lttng_ust_field_integer_hex(const void*, message, message_arg)))
#endif

#endif /* THEIR_PROVIDER_H_ */

#include <lttng/tracepoint-event.h>
