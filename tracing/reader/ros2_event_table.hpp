// SPDX-License-Identifier: Apache-2.0
// The 42 events of the tracepoint provider `ros2`, as tracetools of ros2_tracing 8.10 declares them.
//
// This table is the only place that lists them: the structs, the decoder and the tests come from it. Use:
//   EVENT(Struct, event_name, FIELD(type, name) …)
// in the order of the payload. A trailing underscore of a field's name stands for a name that C++ reserves.
#pragma once

// clang-format off
#define TRACING_ROS2_EVENTS(EVENT, FIELD) \
  EVENT(RclInit, rcl_init, FIELD(kPointer, context_handle) FIELD(kString, version)) \
  EVENT(RclNodeInit, rcl_node_init, \
    FIELD(kPointer, node_handle) FIELD(kPointer, rmw_handle) FIELD(kString, node_name) FIELD(kString, namespace_)) \
  EVENT(RmwPublisherInit, rmw_publisher_init, FIELD(kPointer, rmw_publisher_handle) FIELD(kGid, gid)) \
  EVENT(RclPublisherInit, rcl_publisher_init, \
    FIELD(kPointer, publisher_handle) FIELD(kPointer, node_handle) FIELD(kPointer, rmw_publisher_handle) \
    FIELD(kString, topic_name) FIELD(kUint64, queue_depth)) \
  EVENT(RclcppPublish, rclcpp_publish, FIELD(kPointer, message)) \
  EVENT(RclcppIntraPublish, rclcpp_intra_publish, FIELD(kPointer, publisher_handle) FIELD(kPointer, message)) \
  EVENT(RclPublish, rcl_publish, FIELD(kPointer, publisher_handle) FIELD(kPointer, message)) \
  EVENT(RmwPublish, rmw_publish, \
    FIELD(kPointer, rmw_publisher_handle) FIELD(kPointer, message) FIELD(kInt64, timestamp)) \
  EVENT(RmwSubscriptionInit, rmw_subscription_init, FIELD(kPointer, rmw_subscription_handle) FIELD(kGid, gid)) \
  EVENT(RclSubscriptionInit, rcl_subscription_init, \
    FIELD(kPointer, subscription_handle) FIELD(kPointer, node_handle) FIELD(kPointer, rmw_subscription_handle) \
    FIELD(kString, topic_name) FIELD(kUint64, queue_depth)) \
  EVENT(RclcppSubscriptionInit, rclcpp_subscription_init, \
    FIELD(kPointer, subscription_handle) FIELD(kPointer, subscription)) \
  EVENT(RclcppSubscriptionCallbackAdded, rclcpp_subscription_callback_added, \
    FIELD(kPointer, subscription) FIELD(kPointer, callback)) \
  EVENT(RmwTake, rmw_take, \
    FIELD(kPointer, rmw_subscription_handle) FIELD(kPointer, message) FIELD(kInt64, source_timestamp) \
    FIELD(kBool, taken)) \
  EVENT(RclTake, rcl_take, FIELD(kPointer, message)) \
  EVENT(RclcppTake, rclcpp_take, FIELD(kPointer, message)) \
  EVENT(RclServiceInit, rcl_service_init, \
    FIELD(kPointer, service_handle) FIELD(kPointer, node_handle) FIELD(kPointer, rmw_service_handle) \
    FIELD(kString, service_name)) \
  EVENT(RclcppServiceCallbackAdded, rclcpp_service_callback_added, \
    FIELD(kPointer, service_handle) FIELD(kPointer, callback)) \
  EVENT(RmwTakeRequest, rmw_take_request, \
    FIELD(kPointer, rmw_service_handle) FIELD(kPointer, request) FIELD(kGid, client_gid) \
    FIELD(kInt64, sequence_number) FIELD(kBool, taken)) \
  EVENT(RmwSendResponse, rmw_send_response, \
    FIELD(kPointer, rmw_service_handle) FIELD(kPointer, response) FIELD(kGid, client_gid) \
    FIELD(kInt64, sequence_number) FIELD(kInt64, timestamp)) \
  EVENT(RmwClientInit, rmw_client_init, FIELD(kPointer, rmw_client_handle) FIELD(kGid, gid)) \
  EVENT(RclClientInit, rcl_client_init, \
    FIELD(kPointer, client_handle) FIELD(kPointer, node_handle) FIELD(kPointer, rmw_client_handle) \
    FIELD(kString, service_name)) \
  EVENT(RmwSendRequest, rmw_send_request, \
    FIELD(kPointer, rmw_client_handle) FIELD(kPointer, request) FIELD(kInt64, sequence_number)) \
  EVENT(RmwTakeResponse, rmw_take_response, \
    FIELD(kPointer, rmw_client_handle) FIELD(kPointer, response) FIELD(kInt64, sequence_number) \
    FIELD(kInt64, source_timestamp) FIELD(kBool, taken)) \
  EVENT(RclTimerInit, rcl_timer_init, FIELD(kPointer, timer_handle) FIELD(kInt64, period)) \
  EVENT(RclcppTimerCallbackAdded, rclcpp_timer_callback_added, \
    FIELD(kPointer, timer_handle) FIELD(kPointer, callback)) \
  EVENT(RclcppTimerLinkNode, rclcpp_timer_link_node, FIELD(kPointer, timer_handle) FIELD(kPointer, node_handle)) \
  EVENT(RclcppCallbackRegister, rclcpp_callback_register, FIELD(kPointer, callback) FIELD(kString, symbol)) \
  EVENT(CallbackStart, callback_start, FIELD(kPointer, callback) FIELD(kBool, is_intra_process)) \
  EVENT(CallbackEnd, callback_end, FIELD(kPointer, callback)) \
  EVENT(RclLifecycleStateMachineInit, rcl_lifecycle_state_machine_init, \
    FIELD(kPointer, node_handle) FIELD(kPointer, state_machine)) \
  EVENT(RclLifecycleTransition, rcl_lifecycle_transition, \
    FIELD(kPointer, state_machine) FIELD(kString, start_label) FIELD(kString, goal_label)) \
  EVENT(RclcppExecutorGetNextReady, rclcpp_executor_get_next_ready, ) \
  EVENT(RclcppExecutorWaitForWork, rclcpp_executor_wait_for_work, FIELD(kInt64, timeout)) \
  EVENT(RclcppExecutorExecute, rclcpp_executor_execute, FIELD(kPointer, handle)) \
  EVENT(RclcppIpbToSubscription, rclcpp_ipb_to_subscription, FIELD(kPointer, ipb) FIELD(kPointer, subscription)) \
  EVENT(RclcppBufferToIpb, rclcpp_buffer_to_ipb, FIELD(kPointer, buffer) FIELD(kPointer, ipb)) \
  EVENT(RclcppConstructRingBuffer, rclcpp_construct_ring_buffer, FIELD(kPointer, buffer) FIELD(kUint64, capacity)) \
  EVENT(RclcppRingBufferEnqueue, rclcpp_ring_buffer_enqueue, \
    FIELD(kPointer, buffer) FIELD(kUint64, index) FIELD(kUint64, size) FIELD(kBool, overwritten)) \
  EVENT(RclcppRingBufferDequeue, rclcpp_ring_buffer_dequeue, \
    FIELD(kPointer, buffer) FIELD(kUint64, index) FIELD(kUint64, size)) \
  EVENT(RclcppRingBufferClear, rclcpp_ring_buffer_clear, FIELD(kPointer, buffer)) \
  EVENT(MessageLinkPeriodicAsync, message_link_periodic_async, FIELD(kPointers, subs) FIELD(kPointers, pubs)) \
  EVENT(MessageLinkPartialSync, message_link_partial_sync, FIELD(kPointers, subs) FIELD(kPointers, pubs))
// clang-format on
