// SPDX-License-Identifier: Apache-2.0
/* The payload of the events of provider `ros2_deadline`: callbacks and messages that missed their deadline. provider.h
 * explains the unusual guards. */
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2_deadline

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "provider/provider_deadline.h"

#if !defined(PROVIDER_DEADLINE_H_) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define PROVIDER_DEADLINE_H_

#include <lttng/tracepoint.h>
#include <stdint.h>

/* clang-format off */

/* A callback has ended: all times in nanoseconds. */
LTTNG_UST_TRACEPOINT_EVENT(ros2_deadline, callback,
  LTTNG_UST_TP_ARGS(const void *, callback_arg, int64_t, duration_arg, int64_t, deadline_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)
    lttng_ust_field_integer(int64_t, duration, duration_arg)
    lttng_ust_field_integer(int64_t, deadline, deadline_arg)))

/* A message was passed to rcl too long after it was published. */
LTTNG_UST_TRACEPOINT_EVENT(ros2_deadline, message,
  LTTNG_UST_TP_ARGS(
    const void *, rmw_subscription_handle_arg,
    const void *, message_arg,
    int64_t, age_arg,
    int64_t, deadline_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_subscription_handle, rmw_subscription_handle_arg)
    lttng_ust_field_integer_hex(const void *, message, message_arg)
    lttng_ust_field_integer(int64_t, age, age_arg)
    lttng_ust_field_integer(int64_t, deadline, deadline_arg)))

/* clang-format on */

#endif /* PROVIDER_DEADLINE_H_ */

#include <lttng/tracepoint-event.h>
