// SPDX-License-Identifier: Apache-2.0
/* The payload of every event of provider `ros2_ext`. Rows of tracetools/events_ext.h hand over the arguments in the
 * same order. About the unusual guards see provider.h. */
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2_ext

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "provider_ext.h"

#if !defined(PROVIDER_EXT_H_) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define PROVIDER_EXT_H_

#include <lttng/tracepoint.h>
#include <stdint.h>

#ifndef TRACETOOLS_GID_SIZE
#define TRACETOOLS_GID_SIZE 16
#endif

/* clang-format off */

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_context_fini,
  LTTNG_UST_TP_ARGS(const void *, context_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, context_handle, context_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_node_fini,
  LTTNG_UST_TP_ARGS(const void *, node_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rmw_publisher_fini,
  LTTNG_UST_TP_ARGS(const void *, rmw_publisher_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_publisher_handle, rmw_publisher_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_publisher_fini,
  LTTNG_UST_TP_ARGS(const void *, publisher_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, publisher_handle, publisher_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rmw_subscription_fini,
  LTTNG_UST_TP_ARGS(const void *, rmw_subscription_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_subscription_handle, rmw_subscription_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_subscription_fini,
  LTTNG_UST_TP_ARGS(const void *, subscription_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, subscription_handle, subscription_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_subscription_fini,
  LTTNG_UST_TP_ARGS(const void *, subscription_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, subscription, subscription_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rmw_service_fini,
  LTTNG_UST_TP_ARGS(const void *, rmw_service_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_service_handle, rmw_service_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_service_fini,
  LTTNG_UST_TP_ARGS(const void *, service_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, service_handle, service_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rmw_client_fini,
  LTTNG_UST_TP_ARGS(const void *, rmw_client_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_client_handle, rmw_client_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_client_fini,
  LTTNG_UST_TP_ARGS(const void *, client_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, client_handle, client_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_timer_fini,
  LTTNG_UST_TP_ARGS(const void *, timer_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, timer_handle, timer_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_callback_fini,
  LTTNG_UST_TP_ARGS(const void *, callback_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_lifecycle_state_machine_fini,
  LTTNG_UST_TP_ARGS(const void *, state_machine_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, state_machine, state_machine_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_ipb_fini,
  LTTNG_UST_TP_ARGS(const void *, ipb_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, ipb, ipb_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_ring_buffer_fini,
  LTTNG_UST_TP_ARGS(const void *, buffer_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, buffer, buffer_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rmw_service_init,
  LTTNG_UST_TP_ARGS(const void *, rmw_service_handle_arg, const uint8_t *, gid_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_service_handle, rmw_service_handle_arg)
    lttng_ust_field_array(uint8_t, gid, gid_arg, TRACETOOLS_GID_SIZE)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_client_callback_start,
  LTTNG_UST_TP_ARGS(const void *, client_handle_arg, int64_t, sequence_number_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, client_handle, client_handle_arg)
    lttng_ust_field_integer(int64_t, sequence_number, sequence_number_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_client_callback_end,
  LTTNG_UST_TP_ARGS(const void *, client_handle_arg, int64_t, sequence_number_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, client_handle, client_handle_arg)
    lttng_ust_field_integer(int64_t, sequence_number, sequence_number_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_executor_execute_service,
  LTTNG_UST_TP_ARGS(const void *, service_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, service_handle, service_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_executor_execute_client,
  LTTNG_UST_TP_ARGS(const void *, client_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, client_handle, client_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rclcpp_executor_execute_waitable,
  LTTNG_UST_TP_ARGS(const void *, waitable_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, waitable, waitable_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, state_dump_begin,
  LTTNG_UST_TP_ARGS(uint64_t, events_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer(uint64_t, events, events_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, state_dump_end,
  LTTNG_UST_TP_ARGS(uint64_t, events_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer(uint64_t, events, events_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2_ext, rcl_lifecycle_state,
  LTTNG_UST_TP_ARGS(const void *, state_machine_arg, const char *, label_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, state_machine, state_machine_arg)
    lttng_ust_field_string(label, label_arg)))

/* clang-format on */

#endif /* PROVIDER_EXT_H_ */

#include <lttng/tracepoint-event.h>
