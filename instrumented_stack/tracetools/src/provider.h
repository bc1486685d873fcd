// SPDX-License-Identifier: Apache-2.0
/* The payload of every event of provider `ros2`: field names, order, types and display bases are what the readers of
 * ROS 2 traces rely on. Rows of tracetools/events.h hand over the arguments in the same order.
 *
 * LTTng reads this file several times with different meanings of its macros, hence the unusual guards. */
#undef LTTNG_UST_TRACEPOINT_PROVIDER
#define LTTNG_UST_TRACEPOINT_PROVIDER ros2

#undef LTTNG_UST_TRACEPOINT_INCLUDE
#define LTTNG_UST_TRACEPOINT_INCLUDE "provider.h"

#if !defined(PROVIDER_H_) || defined(LTTNG_UST_TRACEPOINT_HEADER_MULTI_READ)
#define PROVIDER_H_

#include <lttng/tracepoint.h>
#include <stddef.h>
#include <stdint.h>

/* RMW_GID_STORAGE_SIZE, which this package must not include. */
#define TRACETOOLS_GID_SIZE 16

/* clang-format off */

/* Context and node. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_init,
  LTTNG_UST_TP_ARGS(const void *, context_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, context_handle, context_handle_arg)
    lttng_ust_field_string(version, TRACETOOLS_VERSION)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_node_init,
  LTTNG_UST_TP_ARGS(
    const void *, node_handle_arg,
    const void *, rmw_handle_arg,
    const char *, node_name_arg,
    const char *, namespace_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)
    lttng_ust_field_integer_hex(const void *, rmw_handle, rmw_handle_arg)
    lttng_ust_field_string(node_name, node_name_arg)
    lttng_ust_field_string(namespace, namespace_arg)))

/* Publishers. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_publisher_init,
  LTTNG_UST_TP_ARGS(const void *, rmw_publisher_handle_arg, const uint8_t *, gid_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_publisher_handle, rmw_publisher_handle_arg)
    lttng_ust_field_array(uint8_t, gid, gid_arg, TRACETOOLS_GID_SIZE)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_publisher_init,
  LTTNG_UST_TP_ARGS(
    const void *, publisher_handle_arg,
    const void *, node_handle_arg,
    const void *, rmw_publisher_handle_arg,
    const char *, topic_name_arg,
    size_t, queue_depth_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, publisher_handle, publisher_handle_arg)
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)
    lttng_ust_field_integer_hex(const void *, rmw_publisher_handle, rmw_publisher_handle_arg)
    lttng_ust_field_string(topic_name, topic_name_arg)
    lttng_ust_field_integer(size_t, queue_depth, queue_depth_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_publish,
  LTTNG_UST_TP_ARGS(const void *, message_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, message, message_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_intra_publish,
  LTTNG_UST_TP_ARGS(const void *, publisher_handle_arg, const void *, message_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, publisher_handle, publisher_handle_arg)
    lttng_ust_field_integer_hex(const void *, message, message_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_publish,
  LTTNG_UST_TP_ARGS(const void *, publisher_handle_arg, const void *, message_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, publisher_handle, publisher_handle_arg)
    lttng_ust_field_integer_hex(const void *, message, message_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_publish,
  LTTNG_UST_TP_ARGS(const void *, rmw_publisher_handle_arg, const void *, message_arg, int64_t, timestamp_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_publisher_handle, rmw_publisher_handle_arg)
    lttng_ust_field_integer_hex(const void *, message, message_arg)
    lttng_ust_field_integer(int64_t, timestamp, timestamp_arg)))

/* Subscriptions. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_subscription_init,
  LTTNG_UST_TP_ARGS(const void *, rmw_subscription_handle_arg, const uint8_t *, gid_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_subscription_handle, rmw_subscription_handle_arg)
    lttng_ust_field_array(uint8_t, gid, gid_arg, TRACETOOLS_GID_SIZE)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_subscription_init,
  LTTNG_UST_TP_ARGS(
    const void *, subscription_handle_arg,
    const void *, node_handle_arg,
    const void *, rmw_subscription_handle_arg,
    const char *, topic_name_arg,
    size_t, queue_depth_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, subscription_handle, subscription_handle_arg)
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)
    lttng_ust_field_integer_hex(const void *, rmw_subscription_handle, rmw_subscription_handle_arg)
    lttng_ust_field_string(topic_name, topic_name_arg)
    lttng_ust_field_integer(size_t, queue_depth, queue_depth_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_subscription_init,
  LTTNG_UST_TP_ARGS(const void *, subscription_handle_arg, const void *, subscription_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, subscription_handle, subscription_handle_arg)
    lttng_ust_field_integer_hex(const void *, subscription, subscription_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_subscription_callback_added,
  LTTNG_UST_TP_ARGS(const void *, subscription_arg, const void *, callback_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, subscription, subscription_arg)
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_take,
  LTTNG_UST_TP_ARGS(
    const void *, rmw_subscription_handle_arg,
    const void *, message_arg,
    int64_t, source_timestamp_arg,
    int, taken_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_subscription_handle, rmw_subscription_handle_arg)
    lttng_ust_field_integer_hex(const void *, message, message_arg)
    lttng_ust_field_integer(int64_t, source_timestamp, source_timestamp_arg)
    lttng_ust_field_integer(int, taken, taken_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_take,
  LTTNG_UST_TP_ARGS(const void *, message_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, message, message_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_take,
  LTTNG_UST_TP_ARGS(const void *, message_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, message, message_arg)))

/* Services and clients. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_service_init,
  LTTNG_UST_TP_ARGS(
    const void *, service_handle_arg,
    const void *, node_handle_arg,
    const void *, rmw_service_handle_arg,
    const char *, service_name_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, service_handle, service_handle_arg)
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)
    lttng_ust_field_integer_hex(const void *, rmw_service_handle, rmw_service_handle_arg)
    lttng_ust_field_string(service_name, service_name_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_service_callback_added,
  LTTNG_UST_TP_ARGS(const void *, service_handle_arg, const void *, callback_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, service_handle, service_handle_arg)
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_take_request,
  LTTNG_UST_TP_ARGS(
    const void *, rmw_service_handle_arg,
    const void *, request_arg,
    const uint8_t *, client_gid_arg,
    int64_t, sequence_number_arg,
    int, taken_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_service_handle, rmw_service_handle_arg)
    lttng_ust_field_integer_hex(const void *, request, request_arg)
    lttng_ust_field_array(uint8_t, client_gid, client_gid_arg, TRACETOOLS_GID_SIZE)
    lttng_ust_field_integer(int64_t, sequence_number, sequence_number_arg)
    lttng_ust_field_integer(int, taken, taken_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_send_response,
  LTTNG_UST_TP_ARGS(
    const void *, rmw_service_handle_arg,
    const void *, response_arg,
    const uint8_t *, client_gid_arg,
    int64_t, sequence_number_arg,
    int64_t, timestamp_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_service_handle, rmw_service_handle_arg)
    lttng_ust_field_integer_hex(const void *, response, response_arg)
    lttng_ust_field_array(uint8_t, client_gid, client_gid_arg, TRACETOOLS_GID_SIZE)
    lttng_ust_field_integer(int64_t, sequence_number, sequence_number_arg)
    lttng_ust_field_integer(int64_t, timestamp, timestamp_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_client_init,
  LTTNG_UST_TP_ARGS(const void *, rmw_client_handle_arg, const uint8_t *, gid_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_client_handle, rmw_client_handle_arg)
    lttng_ust_field_array(uint8_t, gid, gid_arg, TRACETOOLS_GID_SIZE)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_client_init,
  LTTNG_UST_TP_ARGS(
    const void *, client_handle_arg,
    const void *, node_handle_arg,
    const void *, rmw_client_handle_arg,
    const char *, service_name_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, client_handle, client_handle_arg)
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)
    lttng_ust_field_integer_hex(const void *, rmw_client_handle, rmw_client_handle_arg)
    lttng_ust_field_string(service_name, service_name_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_send_request,
  LTTNG_UST_TP_ARGS(
    const void *, rmw_client_handle_arg,
    const void *, request_arg,
    int64_t, sequence_number_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_client_handle, rmw_client_handle_arg)
    lttng_ust_field_integer_hex(const void *, request, request_arg)
    lttng_ust_field_integer(int64_t, sequence_number, sequence_number_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rmw_take_response,
  LTTNG_UST_TP_ARGS(
    const void *, rmw_client_handle_arg,
    const void *, response_arg,
    int64_t, sequence_number_arg,
    int64_t, source_timestamp_arg,
    int, taken_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, rmw_client_handle, rmw_client_handle_arg)
    lttng_ust_field_integer_hex(const void *, response, response_arg)
    lttng_ust_field_integer(int64_t, sequence_number, sequence_number_arg)
    lttng_ust_field_integer(int64_t, source_timestamp, source_timestamp_arg)
    lttng_ust_field_integer(int, taken, taken_arg)))

/* Timers and callbacks. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_timer_init,
  LTTNG_UST_TP_ARGS(const void *, timer_handle_arg, int64_t, period_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, timer_handle, timer_handle_arg)
    lttng_ust_field_integer(int64_t, period, period_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_timer_callback_added,
  LTTNG_UST_TP_ARGS(const void *, timer_handle_arg, const void *, callback_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, timer_handle, timer_handle_arg)
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_timer_link_node,
  LTTNG_UST_TP_ARGS(const void *, timer_handle_arg, const void *, node_handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, timer_handle, timer_handle_arg)
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_callback_register,
  LTTNG_UST_TP_ARGS(const void *, callback_arg, const char *, symbol_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)
    lttng_ust_field_string(symbol, symbol_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, callback_start,
  LTTNG_UST_TP_ARGS(const void *, callback_arg, int, is_intra_process_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)
    lttng_ust_field_integer(int, is_intra_process, is_intra_process_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, callback_end,
  LTTNG_UST_TP_ARGS(const void *, callback_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, callback, callback_arg)))

/* Lifecycle nodes. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_lifecycle_state_machine_init,
  LTTNG_UST_TP_ARGS(const void *, node_handle_arg, const void *, state_machine_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, node_handle, node_handle_arg)
    lttng_ust_field_integer_hex(const void *, state_machine, state_machine_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rcl_lifecycle_transition,
  LTTNG_UST_TP_ARGS(
    const void *, state_machine_arg,
    const char *, start_label_arg,
    const char *, goal_label_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, state_machine, state_machine_arg)
    lttng_ust_field_string(start_label, start_label_arg)
    lttng_ust_field_string(goal_label, goal_label_arg)))

/* Executors. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_executor_get_next_ready,
  LTTNG_UST_TP_ARGS(),
  LTTNG_UST_TP_FIELDS())

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_executor_wait_for_work,
  LTTNG_UST_TP_ARGS(int64_t, timeout_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer(int64_t, timeout, timeout_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_executor_execute,
  LTTNG_UST_TP_ARGS(const void *, handle_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, handle, handle_arg)))

/* Intra-process buffers. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_ipb_to_subscription,
  LTTNG_UST_TP_ARGS(const void *, ipb_arg, const void *, subscription_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, ipb, ipb_arg)
    lttng_ust_field_integer_hex(const void *, subscription, subscription_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_buffer_to_ipb,
  LTTNG_UST_TP_ARGS(const void *, buffer_arg, const void *, ipb_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, buffer, buffer_arg)
    lttng_ust_field_integer_hex(const void *, ipb, ipb_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_construct_ring_buffer,
  LTTNG_UST_TP_ARGS(const void *, buffer_arg, uint64_t, capacity_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, buffer, buffer_arg)
    lttng_ust_field_integer(uint64_t, capacity, capacity_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_ring_buffer_enqueue,
  LTTNG_UST_TP_ARGS(const void *, buffer_arg, uint64_t, index_arg, uint64_t, size_arg, int, overwritten_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, buffer, buffer_arg)
    lttng_ust_field_integer(uint64_t, index, index_arg)
    lttng_ust_field_integer(uint64_t, size, size_arg)
    lttng_ust_field_integer(int, overwritten, overwritten_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_ring_buffer_dequeue,
  LTTNG_UST_TP_ARGS(const void *, buffer_arg, uint64_t, index_arg, uint64_t, size_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, buffer, buffer_arg)
    lttng_ust_field_integer(uint64_t, index, index_arg)
    lttng_ust_field_integer(uint64_t, size, size_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, rclcpp_ring_buffer_clear,
  LTTNG_UST_TP_ARGS(const void *, buffer_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_integer_hex(const void *, buffer, buffer_arg)))

/* Message links. */

LTTNG_UST_TRACEPOINT_EVENT(ros2, message_link_periodic_async,
  LTTNG_UST_TP_ARGS(
    const void **, subs_arg,
    size_t, num_subs_arg,
    const void **, pubs_arg,
    size_t, num_pubs_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_sequence_hex(const void *, subs, subs_arg, size_t, num_subs_arg)
    lttng_ust_field_sequence_hex(const void *, pubs, pubs_arg, size_t, num_pubs_arg)))

LTTNG_UST_TRACEPOINT_EVENT(ros2, message_link_partial_sync,
  LTTNG_UST_TP_ARGS(
    const void **, subs_arg,
    size_t, num_subs_arg,
    const void **, pubs_arg,
    size_t, num_pubs_arg),
  LTTNG_UST_TP_FIELDS(
    lttng_ust_field_sequence_hex(const void *, subs, subs_arg, size_t, num_subs_arg)
    lttng_ust_field_sequence_hex(const void *, pubs, pubs_arg, size_t, num_pubs_arg)))

/* clang-format on */

#endif /* PROVIDER_H_ */

#include <lttng/tracepoint-event.h>
