/* SPDX-License-Identifier: Apache-2.0
 * The functions of their tracetools that record. */
#include "their_interface.h"

#ifndef THEIR_SILENCE
#include "their_provider.h"

void ros_trace_rcl_init(const void* context) {
  lttng_ust_tracepoint(ros2, rcl_init, context);
}

void ros_trace_callback_end(const void* callback) {
  lttng_ust_tracepoint(ros2, callback_end, callback);
}

#if THEIR_VERSION >= 801
void ros_trace_rmw_publish(const void* rmw_publisher, const void* message, int64_t timestamp) {
  lttng_ust_tracepoint(ros2, rmw_publish, rmw_publisher, message, timestamp);
}
#else
void ros_trace_rmw_publish(const void* message) {
  lttng_ust_tracepoint(ros2, rmw_publish, message);
}
#endif

#endif
