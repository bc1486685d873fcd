// SPDX-License-Identifier: Apache-2.0
#pragma once

// The one declaration of the events of ROS 2. From it come the functions of tracetools, the probes of LTTng and of
// USDT, the structs and the decoder of trace_reader, the names that a trace session records, and the names in Python.
//
// A row is EVENT(given, name, Struct, group, field...):
//   given   passed unchanged to every row by the user of the table
//   name    the event's name: `ros2:name` in a trace, ros_trace_name in C
//   Struct  the name as a C++ type, for readers of traces
//   group   the subject of the event; a session may drop a whole group if recording costs too much:
//             init       a fact about an object that is recorded once: never dropped
//             end        the end of an object: never dropped
//             state      a change of state, or a note about the trace itself: never dropped
//             executor   what executors wait for and execute
//             buffers    messages in the ring buffers of intra-process communication
//             layers     publishing and taking in rclcpp and rcl
//             messages   publishing and taking in rmw, and within the process
//             services   requests and responses
//             callbacks  beginning and end of callbacks
//   field   (type, name), in the order of the payload and of the C parameters; at least one, at most six
//
// Types of fields, with the C parameter and what LTTng records:
//   pointer         const void *       64 bits, displayed in hexadecimal
//   string          const char *       a text; null is recorded as "(null)"
//   keyword_string  const char *       like string, for a name that C++ reserves: C++ adds an underscore to it
//   size            size_t             64 bits, unsigned
//   uint64, int64   uint64_t, int64_t  64 bits
//   boolean         bool               32 bits, 0 or 1
//   gid             const uint8_t *    16 bytes
//   pointers        const void ** name, size_t num_name: a sequence of pointers, after its length
//   version         no parameter: the version of tracetools, a text
//   ignored         const void *       not recorded
//   nothing         the one field, without a name, of an event without fields
//
// A "handle" is the address of the layer's own struct (rcl_node_t *, rmw_publisher_t *). A gid identifies a DDS
// endpoint. Times and periods are nanoseconds. README.md of tracetools explains how to add an event.

// TRACETOOLS_INTERFACE: the version of ROS 2's tracetools, as 100 * MAJOR + MINOR, from which on functions and fields
// are as this table says. It is 8.4 but for the libraries that nodes of another ROS 2 preload (docs/tracetools.md).
#ifndef TRACETOOLS_INTERFACE
#define TRACETOOLS_INTERFACE 804
#endif
#if TRACETOOLS_INTERFACE < 801
#define TRACETOOLS_RMW_PUBLISH_FIELDS (pointer, message)
#else
#define TRACETOOLS_RMW_PUBLISH_FIELDS (pointer, rmw_publisher_handle), (pointer, message), (int64, timestamp)
#endif

// The events of provider `ros2`. Names, fields, their order and types are those of tracetools of ros2_tracing 8.10.
// Other tools rely on them.
// clang-format off
#define TRACETOOLS_EVENT_TABLE(EVENT, given) \
  /* A context was initialised. tracetools adds its own version. */ \
  EVENT(given, rcl_init, RclInit, init, (pointer, context_handle), (version, version)) \
  EVENT(given, rcl_node_init, RclNodeInit, init, \
    (pointer, node_handle), (pointer, rmw_handle), (string, node_name), (keyword_string, namespace)) \
  \
  /* Publishers. rclcpp_publish takes a publisher handle for compatibility and ignores it. */ \
  EVENT(given, rmw_publisher_init, RmwPublisherInit, init, (pointer, rmw_publisher_handle), (gid, gid)) \
  EVENT(given, rcl_publisher_init, RclPublisherInit, init, \
    (pointer, publisher_handle), (pointer, node_handle), (pointer, rmw_publisher_handle), (string, topic_name), \
    (size, queue_depth)) \
  EVENT(given, rclcpp_publish, RclcppPublish, layers, (ignored, publisher_handle), (pointer, message)) \
  EVENT(given, rclcpp_intra_publish, RclcppIntraPublish, messages, (pointer, publisher_handle), (pointer, message)) \
  EVENT(given, rcl_publish, RclPublish, layers, (pointer, publisher_handle), (pointer, message)) \
  EVENT(given, rmw_publish, RmwPublish, messages, TRACETOOLS_RMW_PUBLISH_FIELDS) \
  \
  /* Subscriptions. */ \
  EVENT(given, rmw_subscription_init, RmwSubscriptionInit, init, (pointer, rmw_subscription_handle), (gid, gid)) \
  EVENT(given, rcl_subscription_init, RclSubscriptionInit, init, \
    (pointer, subscription_handle), (pointer, node_handle), (pointer, rmw_subscription_handle), \
    (string, topic_name), (size, queue_depth)) \
  EVENT(given, rclcpp_subscription_init, RclcppSubscriptionInit, init, \
    (pointer, subscription_handle), (pointer, subscription)) \
  EVENT(given, rclcpp_subscription_callback_added, RclcppSubscriptionCallbackAdded, init, \
    (pointer, subscription), (pointer, callback)) \
  EVENT(given, rmw_take, RmwTake, messages, \
    (pointer, rmw_subscription_handle), (pointer, message), (int64, source_timestamp), (boolean, taken)) \
  EVENT(given, rcl_take, RclTake, layers, (pointer, message)) \
  EVENT(given, rclcpp_take, RclcppTake, layers, (pointer, message)) \
  \
  /* Services and clients. */ \
  EVENT(given, rcl_service_init, RclServiceInit, init, \
    (pointer, service_handle), (pointer, node_handle), (pointer, rmw_service_handle), (string, service_name)) \
  EVENT(given, rclcpp_service_callback_added, RclcppServiceCallbackAdded, init, \
    (pointer, service_handle), (pointer, callback)) \
  EVENT(given, rmw_take_request, RmwTakeRequest, services, \
    (pointer, rmw_service_handle), (pointer, request), (gid, client_gid), (int64, sequence_number), \
    (boolean, taken)) \
  EVENT(given, rmw_send_response, RmwSendResponse, services, \
    (pointer, rmw_service_handle), (pointer, response), (gid, client_gid), (int64, sequence_number), \
    (int64, timestamp)) \
  EVENT(given, rmw_client_init, RmwClientInit, init, (pointer, rmw_client_handle), (gid, gid)) \
  EVENT(given, rcl_client_init, RclClientInit, init, \
    (pointer, client_handle), (pointer, node_handle), (pointer, rmw_client_handle), (string, service_name)) \
  EVENT(given, rmw_send_request, RmwSendRequest, services, \
    (pointer, rmw_client_handle), (pointer, request), (int64, sequence_number)) \
  EVENT(given, rmw_take_response, RmwTakeResponse, services, \
    (pointer, rmw_client_handle), (pointer, response), (int64, sequence_number), (int64, source_timestamp), \
    (boolean, taken)) \
  \
  /* Timers and callbacks. The symbol may be null: get_symbol in utils.hpp says when. */ \
  EVENT(given, rcl_timer_init, RclTimerInit, init, (pointer, timer_handle), (int64, period)) \
  EVENT(given, rclcpp_timer_callback_added, RclcppTimerCallbackAdded, init, \
    (pointer, timer_handle), (pointer, callback)) \
  EVENT(given, rclcpp_timer_link_node, RclcppTimerLinkNode, init, (pointer, timer_handle), (pointer, node_handle)) \
  EVENT(given, rclcpp_callback_register, RclcppCallbackRegister, init, (pointer, callback), (string, symbol)) \
  EVENT(given, callback_start, CallbackStart, callbacks, (pointer, callback), (boolean, is_intra_process)) \
  EVENT(given, callback_end, CallbackEnd, callbacks, (pointer, callback)) \
  \
  /* Lifecycle nodes. */ \
  EVENT(given, rcl_lifecycle_state_machine_init, RclLifecycleStateMachineInit, init, \
    (pointer, node_handle), (pointer, state_machine)) \
  EVENT(given, rcl_lifecycle_transition, RclLifecycleTransition, state, \
    (pointer, state_machine), (string, start_label), (string, goal_label)) \
  \
  /* Executors. A timeout of -1 ns means no limit. */ \
  EVENT(given, rclcpp_executor_get_next_ready, RclcppExecutorGetNextReady, executor, (nothing, )) \
  EVENT(given, rclcpp_executor_wait_for_work, RclcppExecutorWaitForWork, executor, (int64, timeout)) \
  EVENT(given, rclcpp_executor_execute, RclcppExecutorExecute, executor, (pointer, handle)) \
  \
  /* Intra-process buffers ("ipb") and the ring buffers under them. */ \
  EVENT(given, rclcpp_ipb_to_subscription, RclcppIpbToSubscription, init, (pointer, ipb), (pointer, subscription)) \
  EVENT(given, rclcpp_buffer_to_ipb, RclcppBufferToIpb, init, (pointer, buffer), (pointer, ipb)) \
  EVENT(given, rclcpp_construct_ring_buffer, RclcppConstructRingBuffer, init, (pointer, buffer), (uint64, capacity)) \
  EVENT(given, rclcpp_ring_buffer_enqueue, RclcppRingBufferEnqueue, buffers, \
    (pointer, buffer), (uint64, index), (uint64, size), (boolean, overwritten)) \
  EVENT(given, rclcpp_ring_buffer_dequeue, RclcppRingBufferDequeue, buffers, \
    (pointer, buffer), (uint64, index), (uint64, size)) \
  EVENT(given, rclcpp_ring_buffer_clear, RclcppRingBufferClear, buffers, (pointer, buffer)) \
  \
  /* Which inputs cause which outputs of a node that caches messages: user code calls it once with rcl handles. */ \
  EVENT(given, message_link_periodic_async, MessageLinkPeriodicAsync, init, (pointers, subs), (pointers, pubs)) \
  EVENT(given, message_link_partial_sync, MessageLinkPartialSync, init, (pointers, subs), (pointers, pubs))

// The events of provider `ros2_ext`: they are not in ROS 2's tracetools. The provider is separate, so that
// `ros2:*` stays what other tools expect. Enable `ros2_ext:*` to record them.
#define TRACETOOLS_EXT_EVENT_TABLE(EVENT, given) \
  /* The end of an object; another object may have its address afterwards. Each event ends an object that an init */ \
  /* event began: rcl_publisher_fini belongs to ros2:rcl_publisher_init, rclcpp_callback_fini to */ \
  /* ros2:rclcpp_callback_register. */ \
  EVENT(given, rcl_context_fini, RclContextFini, end, (pointer, context_handle)) \
  EVENT(given, rcl_node_fini, RclNodeFini, end, (pointer, node_handle)) \
  EVENT(given, rmw_publisher_fini, RmwPublisherFini, end, (pointer, rmw_publisher_handle)) \
  EVENT(given, rcl_publisher_fini, RclPublisherFini, end, (pointer, publisher_handle)) \
  EVENT(given, rmw_subscription_fini, RmwSubscriptionFini, end, (pointer, rmw_subscription_handle)) \
  EVENT(given, rcl_subscription_fini, RclSubscriptionFini, end, (pointer, subscription_handle)) \
  EVENT(given, rclcpp_subscription_fini, RclcppSubscriptionFini, end, (pointer, subscription)) \
  EVENT(given, rmw_service_fini, RmwServiceFini, end, (pointer, rmw_service_handle)) \
  EVENT(given, rcl_service_fini, RclServiceFini, end, (pointer, service_handle)) \
  EVENT(given, rmw_client_fini, RmwClientFini, end, (pointer, rmw_client_handle)) \
  EVENT(given, rcl_client_fini, RclClientFini, end, (pointer, client_handle)) \
  EVENT(given, rcl_timer_fini, RclTimerFini, end, (pointer, timer_handle)) \
  EVENT(given, rclcpp_callback_fini, RclcppCallbackFini, end, (pointer, callback)) \
  EVENT(given, rcl_lifecycle_state_machine_fini, RclLifecycleStateMachineFini, end, (pointer, state_machine)) \
  EVENT(given, rclcpp_ipb_fini, RclcppIpbFini, end, (pointer, ipb)) \
  EVENT(given, rclcpp_ring_buffer_fini, RclcppRingBufferFini, end, (pointer, buffer)) \
  \
  /* A service of the middleware. The gid is that of its request reader. */ \
  EVENT(given, rmw_service_init, RmwServiceInit, init, (pointer, rmw_service_handle), (gid, gid)) \
  \
  /* The quality of service that a publisher or a subscription really has, after rmw_*_init. history_depth is 0 if the */ \
  /* endpoint keeps all messages. A subscription has is_filtered set if it has a content filter. The event of a */ \
  /* subscription comes again when its filter is set or removed. */ \
  EVENT(given, rmw_publisher_qos, RmwPublisherQos, init, \
    (pointer, rmw_publisher_handle), (boolean, reliable), (uint64, history_depth), (boolean, transient_local)) \
  EVENT(given, rmw_subscription_qos, RmwSubscriptionQos, init, \
    (pointer, rmw_subscription_handle), (boolean, reliable), (uint64, history_depth), (boolean, transient_local), \
    (boolean, is_filtered)) \
  \
  /* Before and after a client handles a response: it runs a callback, or makes a future ready. */ \
  EVENT(given, rclcpp_client_callback_start, RclcppClientCallbackStart, services, \
    (pointer, client_handle), (int64, sequence_number)) \
  EVENT(given, rclcpp_client_callback_end, RclcppClientCallbackEnd, services, \
    (pointer, client_handle), (int64, sequence_number)) \
  \
  /* An executor executes an entity that ros2:rclcpp_executor_execute does not cover. Handles are those of rcl. */ \
  EVENT(given, rclcpp_executor_execute_service, RclcppExecutorExecuteService, executor, (pointer, service_handle)) \
  EVENT(given, rclcpp_executor_execute_client, RclcppExecutorExecuteClient, executor, (pointer, client_handle)) \
  EVENT(given, rclcpp_executor_execute_waitable, RclcppExecutorExecuteWaitable, executor, (pointer, waitable)) \
  \
  /* Before and after the init events of objects that are older than the session: see object_state.hpp. */ \
  EVENT(given, state_dump_begin, StateDumpBegin, state, (uint64, events)) \
  EVENT(given, state_dump_end, StateDumpEnd, state, (uint64, events)) \
  \
  /* In a state dump: the current state of a lifecycle node. */ \
  EVENT(given, rcl_lifecycle_state, RclLifecycleState, state, (pointer, state_machine), (string, label))

// TRACETOOLS_EACH_FIELD(USE, field...): USE(type, name) for each field of a row, in order. There are no blanks
// between them, because LTTng compares the text of its arguments.
#define TRACETOOLS_EACH_FIELD(USE, ...) TRACETOOLS_EACH_PICK(__VA_ARGS__, 6, 5, 4, 3, 2, 1, )(USE, __VA_ARGS__)
#define TRACETOOLS_EACH_PICK(_1, _2, _3, _4, _5, _6, count, ...) TRACETOOLS_EACH_##count
#define TRACETOOLS_EACH_1(USE, field) USE field
#define TRACETOOLS_EACH_2(USE, field, ...) TRACETOOLS_EACH_1(USE, field)TRACETOOLS_EACH_1(USE, __VA_ARGS__)
#define TRACETOOLS_EACH_3(USE, field, ...) TRACETOOLS_EACH_1(USE, field)TRACETOOLS_EACH_2(USE, __VA_ARGS__)
#define TRACETOOLS_EACH_4(USE, field, ...) TRACETOOLS_EACH_1(USE, field)TRACETOOLS_EACH_3(USE, __VA_ARGS__)
#define TRACETOOLS_EACH_5(USE, field, ...) TRACETOOLS_EACH_1(USE, field)TRACETOOLS_EACH_4(USE, __VA_ARGS__)
#define TRACETOOLS_EACH_6(USE, field, ...) TRACETOOLS_EACH_1(USE, field)TRACETOOLS_EACH_5(USE, __VA_ARGS__)
// clang-format on
