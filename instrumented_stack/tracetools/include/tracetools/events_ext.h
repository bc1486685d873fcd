// SPDX-License-Identifier: Apache-2.0
#ifndef TRACETOOLS__EVENTS_EXT_H_
#define TRACETOOLS__EVENTS_EXT_H_

/// The events of provider `ros2_ext`: what ROS 2's tracetools does not record. Rows as in events.h.
///
/// The provider is separate so that `ros2:*` stays what other tools expect; enable `ros2_ext:*` to get these.
// clang-format off
#define TRACETOOLS_EXT_EVENTS(EVENT) \
  /* The end of an object; from here on its address may name another one. Each ends what the init event of the same */ \
  /* object began: rcl_publisher_fini what ros2:rcl_publisher_init, rclcpp_callback_fini what */ \
  /* ros2:rclcpp_callback_register began. */ \
  EVENT(rcl_context_fini, (const void * context_handle), (context_handle)) \
  EVENT(rcl_node_fini, (const void * node_handle), (node_handle)) \
  EVENT(rmw_publisher_fini, (const void * rmw_publisher_handle), (rmw_publisher_handle)) \
  EVENT(rcl_publisher_fini, (const void * publisher_handle), (publisher_handle)) \
  EVENT(rmw_subscription_fini, (const void * rmw_subscription_handle), (rmw_subscription_handle)) \
  EVENT(rcl_subscription_fini, (const void * subscription_handle), (subscription_handle)) \
  EVENT(rclcpp_subscription_fini, (const void * subscription), (subscription)) \
  EVENT(rmw_service_fini, (const void * rmw_service_handle), (rmw_service_handle)) \
  EVENT(rcl_service_fini, (const void * service_handle), (service_handle)) \
  EVENT(rmw_client_fini, (const void * rmw_client_handle), (rmw_client_handle)) \
  EVENT(rcl_client_fini, (const void * client_handle), (client_handle)) \
  EVENT(rcl_timer_fini, (const void * timer_handle), (timer_handle)) \
  EVENT(rclcpp_callback_fini, (const void * callback), (callback)) \
  EVENT(rcl_lifecycle_state_machine_fini, (const void * state_machine), (state_machine)) \
  EVENT(rclcpp_ipb_fini, (const void * ipb), (ipb)) \
  EVENT(rclcpp_ring_buffer_fini, (const void * buffer), (buffer)) \
  \
  /* A service of the middleware; gid is that of the reader of its requests. */ \
  EVENT(rmw_service_init, (const void * rmw_service_handle, const uint8_t * gid), (rmw_service_handle, gid)) \
  \
  /* Around what a client does with a response: a callback, or making a future ready. */ \
  EVENT(rclcpp_client_callback_start, (const void * client_handle, int64_t sequence_number), \
    (client_handle, sequence_number)) \
  EVENT(rclcpp_client_callback_end, (const void * client_handle, int64_t sequence_number), \
    (client_handle, sequence_number)) \
  \
  /* An executor turns to something that ros2:rclcpp_executor_execute does not tell of; handles are rcl's. */ \
  EVENT(rclcpp_executor_execute_service, (const void * service_handle), (service_handle)) \
  EVENT(rclcpp_executor_execute_client, (const void * client_handle), (client_handle)) \
  EVENT(rclcpp_executor_execute_waitable, (const void * waitable), (waitable)) \
  \
  /* Around the init events of objects that lived already when a session started: see object_state.hpp. */ \
  EVENT(state_dump_begin, (uint64_t events), (events)) \
  EVENT(state_dump_end, (uint64_t events), (events)) \
  /* In a state dump: the state that a lifecycle node is in. */ \
  EVENT(rcl_lifecycle_state, (const void * state_machine, const char * label), (state_machine, label))
// clang-format on

#endif  // TRACETOOLS__EVENTS_EXT_H_
