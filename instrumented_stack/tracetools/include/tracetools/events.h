// SPDX-License-Identifier: Apache-2.0
#ifndef TRACETOOLS__EVENTS_H_
#define TRACETOOLS__EVENTS_H_

/// The events of provider `ros2`: the one list from which the functions of tracetools.h are declared and defined.
///
/// A row is EVENT(name, (parameters of the C function), (arguments handed to the provider)). Events named *_init,
/// *_added, *_register, *_link_node and the like tell a fact about an object once; the others happen at run time and
/// refer to objects by address only. What is recorded for each, and in which order, is in src/provider.h.
///
/// A "handle" is the address of the layer's own struct (rcl_node_t *, rmw_publisher_t *), a gid is 16 bytes, times and
/// periods are nanoseconds.
// clang-format off
#define TRACETOOLS_EVENTS(EVENT) \
  /* A context was initialised; the provider adds the version of tracetools. */ \
  EVENT(rcl_init, (const void * context_handle), (context_handle)) \
  EVENT(rcl_node_init, \
    (const void * node_handle, const void * rmw_handle, const char * node_name, const char * node_namespace), \
    (node_handle, rmw_handle, node_name, node_namespace)) \
  \
  /* Publishers. rclcpp_publish takes a publisher handle for compatibility and ignores it. */ \
  EVENT(rmw_publisher_init, (const void * rmw_publisher_handle, const uint8_t * gid), (rmw_publisher_handle, gid)) \
  EVENT(rcl_publisher_init, \
    (const void * publisher_handle, const void * node_handle, const void * rmw_publisher_handle, \
     const char * topic_name, const size_t queue_depth), \
    (publisher_handle, node_handle, rmw_publisher_handle, topic_name, queue_depth)) \
  EVENT(rclcpp_publish, (const void * publisher_handle, const void * message), (message)) \
  EVENT(rclcpp_intra_publish, (const void * publisher_handle, const void * message), (publisher_handle, message)) \
  EVENT(rcl_publish, (const void * publisher_handle, const void * message), (publisher_handle, message)) \
  EVENT(rmw_publish, (const void * rmw_publisher_handle, const void * message, int64_t timestamp), \
    (rmw_publisher_handle, message, timestamp)) \
  \
  /* Subscriptions. */ \
  EVENT(rmw_subscription_init, \
    (const void * rmw_subscription_handle, const uint8_t * gid), (rmw_subscription_handle, gid)) \
  EVENT(rcl_subscription_init, \
    (const void * subscription_handle, const void * node_handle, const void * rmw_subscription_handle, \
     const char * topic_name, const size_t queue_depth), \
    (subscription_handle, node_handle, rmw_subscription_handle, topic_name, queue_depth)) \
  EVENT(rclcpp_subscription_init, \
    (const void * subscription_handle, const void * subscription), (subscription_handle, subscription)) \
  EVENT(rclcpp_subscription_callback_added, \
    (const void * subscription, const void * callback), (subscription, callback)) \
  EVENT(rmw_take, \
    (const void * rmw_subscription_handle, const void * message, int64_t source_timestamp, const bool taken), \
    (rmw_subscription_handle, message, source_timestamp, taken)) \
  EVENT(rcl_take, (const void * message), (message)) \
  EVENT(rclcpp_take, (const void * message), (message)) \
  \
  /* Services and clients. */ \
  EVENT(rcl_service_init, \
    (const void * service_handle, const void * node_handle, const void * rmw_service_handle, \
     const char * service_name), \
    (service_handle, node_handle, rmw_service_handle, service_name)) \
  EVENT(rclcpp_service_callback_added, \
    (const void * service_handle, const void * callback), (service_handle, callback)) \
  EVENT(rmw_take_request, \
    (const void * rmw_service_handle, const void * request, const uint8_t * client_gid, int64_t sequence_number, \
     const bool taken), \
    (rmw_service_handle, request, client_gid, sequence_number, taken)) \
  EVENT(rmw_send_response, \
    (const void * rmw_service_handle, const void * response, const uint8_t * client_gid, int64_t sequence_number, \
     int64_t timestamp), \
    (rmw_service_handle, response, client_gid, sequence_number, timestamp)) \
  EVENT(rmw_client_init, (const void * rmw_client_handle, const uint8_t * gid), (rmw_client_handle, gid)) \
  EVENT(rcl_client_init, \
    (const void * client_handle, const void * node_handle, const void * rmw_client_handle, \
     const char * service_name), \
    (client_handle, node_handle, rmw_client_handle, service_name)) \
  EVENT(rmw_send_request, (const void * rmw_client_handle, const void * request, int64_t sequence_number), \
    (rmw_client_handle, request, sequence_number)) \
  EVENT(rmw_take_response, \
    (const void * rmw_client_handle, const void * response, int64_t sequence_number, int64_t source_timestamp, \
     const bool taken), \
    (rmw_client_handle, response, sequence_number, source_timestamp, taken)) \
  \
  /* Timers and callbacks. The symbol may be null: get_symbol in utils.hpp says when. */ \
  EVENT(rcl_timer_init, (const void * timer_handle, int64_t period), (timer_handle, period)) \
  EVENT(rclcpp_timer_callback_added, (const void * timer_handle, const void * callback), (timer_handle, callback)) \
  EVENT(rclcpp_timer_link_node, (const void * timer_handle, const void * node_handle), (timer_handle, node_handle)) \
  EVENT(rclcpp_callback_register, (const void * callback, const char * symbol), (callback, symbol)) \
  EVENT(callback_start, (const void * callback, const bool is_intra_process), (callback, is_intra_process)) \
  EVENT(callback_end, (const void * callback), (callback)) \
  \
  /* Lifecycle nodes. */ \
  EVENT(rcl_lifecycle_state_machine_init, \
    (const void * node_handle, const void * state_machine), (node_handle, state_machine)) \
  EVENT(rcl_lifecycle_transition, \
    (const void * state_machine, const char * start_label, const char * goal_label), \
    (state_machine, start_label, goal_label)) \
  \
  /* Executors; a timeout of -1 ns waits for ever. */ \
  EVENT(rclcpp_executor_get_next_ready, (void), ()) \
  EVENT(rclcpp_executor_wait_for_work, (const int64_t timeout), (timeout)) \
  EVENT(rclcpp_executor_execute, (const void * handle), (handle)) \
  \
  /* Intra-process buffers ("ipb") and the ring buffers under them. */ \
  EVENT(rclcpp_ipb_to_subscription, (const void * ipb, const void * subscription), (ipb, subscription)) \
  EVENT(rclcpp_buffer_to_ipb, (const void * buffer, const void * ipb), (buffer, ipb)) \
  EVENT(rclcpp_construct_ring_buffer, (const void * buffer, const uint64_t capacity), (buffer, capacity)) \
  EVENT(rclcpp_ring_buffer_enqueue, \
    (const void * buffer, const uint64_t index, const uint64_t size, const bool overwritten), \
    (buffer, index, size, overwritten)) \
  EVENT(rclcpp_ring_buffer_dequeue, \
    (const void * buffer, const uint64_t index, const uint64_t size), (buffer, index, size)) \
  EVENT(rclcpp_ring_buffer_clear, (const void * buffer), (buffer)) \
  \
  /* Which inputs cause which outputs of a node that caches messages: called once by user code with rcl handles. */ \
  EVENT(message_link_periodic_async, \
    (const void ** subs, size_t num_subs, const void ** pubs, size_t num_pubs), (subs, num_subs, pubs, num_pubs)) \
  EVENT(message_link_partial_sync, \
    (const void ** subs, size_t num_subs, const void ** pubs, size_t num_pubs), (subs, num_subs, pubs, num_pubs))
// clang-format on

#endif  // TRACETOOLS__EVENTS_H_
