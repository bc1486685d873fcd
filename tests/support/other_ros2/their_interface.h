/* SPDX-License-Identifier: Apache-2.0
 * The functions of the tracetools of a ROS 2, of version THEIR_VERSION (100 * MAJOR + MINOR): a stand-in of the tests
 * for the package of a distribution. docs/tracetools.md tells when each came. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* FUNCTION(name, parameters) for each event of the version. */
#define THEIR_FUNCTIONS(FUNCTION)                                                                                 \
  FUNCTION(rcl_init, (const void* context))                                                                       \
  FUNCTION(rcl_node_init, (const void* node, const void* rmw, const char* name, const char* in_namespace))        \
  FUNCTION(rmw_publisher_init, (const void* rmw_publisher, const uint8_t* gid))                                   \
  FUNCTION(rcl_publisher_init,                                                                                    \
           (const void* publisher, const void* node, const void* rmw_publisher, const char* topic, size_t depth)) \
  FUNCTION(rclcpp_publish, (const void* publisher, const void* message))                                          \
  FUNCTION(rcl_publish, (const void* publisher, const void* message))                                             \
  FUNCTION(rmw_publish, THEIR_PUBLISH)                                                                            \
  FUNCTION(rmw_subscription_init, (const void* rmw_subscription, const uint8_t* gid))                             \
  FUNCTION(rcl_subscription_init, (const void* subscription, const void* node, const void* rmw_subscription,      \
                                   const char* topic, size_t depth))                                              \
  FUNCTION(rclcpp_subscription_init, (const void* handle, const void* subscription))                              \
  FUNCTION(rclcpp_subscription_callback_added, (const void* subscription, const void* callback))                  \
  FUNCTION(rmw_take, (const void* rmw_subscription, const void* message, int64_t source_timestamp, bool taken))   \
  FUNCTION(rcl_take, (const void* message))                                                                       \
  FUNCTION(rclcpp_take, (const void* message))                                                                    \
  FUNCTION(rcl_service_init, (const void* service, const void* node, const void* rmw_service, const char* name))  \
  FUNCTION(rclcpp_service_callback_added, (const void* service, const void* callback))                            \
  FUNCTION(rcl_client_init, (const void* client, const void* node, const void* rmw_client, const char* name))     \
  FUNCTION(rcl_timer_init, (const void* timer, int64_t period))                                                   \
  FUNCTION(rclcpp_timer_callback_added, (const void* timer, const void* callback))                                \
  FUNCTION(rclcpp_timer_link_node, (const void* timer, const void* node))                                         \
  FUNCTION(rclcpp_callback_register, (const void* callback, const char* symbol))                                  \
  FUNCTION(callback_start, (const void* callback, bool is_intra_process))                                         \
  FUNCTION(callback_end, (const void* callback))                                                                  \
  FUNCTION(rcl_lifecycle_state_machine_init, (const void* node, const void* machine))                             \
  FUNCTION(rcl_lifecycle_transition, (const void* machine, const char* start, const char* goal))                  \
  FUNCTION(rclcpp_executor_get_next_ready, (void))                                                                \
  FUNCTION(rclcpp_executor_wait_for_work, (int64_t timeout))                                                      \
  FUNCTION(rclcpp_executor_execute, (const void* handle))                                                         \
  THEIR_INTRA_PROCESS_FUNCTIONS(FUNCTION)                                                                         \
  THEIR_SERVICE_FUNCTIONS(FUNCTION)                                                                               \
  THEIR_LINK_FUNCTIONS(FUNCTION)

#if THEIR_VERSION >= 801
#define THEIR_PUBLISH (const void* rmw_publisher, const void* message, int64_t timestamp)
#else
#define THEIR_PUBLISH (const void* message)
#endif

#if THEIR_VERSION >= 601
#define THEIR_INTRA_PROCESS_FUNCTIONS(FUNCTION)                                                               \
  FUNCTION(rclcpp_intra_publish, (const void* publisher, const void* message))                                \
  FUNCTION(rclcpp_ipb_to_subscription, (const void* ipb, const void* subscription))                           \
  FUNCTION(rclcpp_buffer_to_ipb, (const void* buffer, const void* ipb))                                       \
  FUNCTION(rclcpp_construct_ring_buffer, (const void* buffer, uint64_t capacity))                             \
  FUNCTION(rclcpp_ring_buffer_enqueue, (const void* buffer, uint64_t index, uint64_t size, bool overwritten)) \
  FUNCTION(rclcpp_ring_buffer_dequeue, (const void* buffer, uint64_t index, uint64_t size))                   \
  FUNCTION(rclcpp_ring_buffer_clear, (const void* buffer))
#else
#define THEIR_INTRA_PROCESS_FUNCTIONS(FUNCTION)
#endif

#if THEIR_VERSION >= 805
#define THEIR_SERVICE_FUNCTIONS(FUNCTION)                                                                \
  FUNCTION(rmw_take_request, (const void* rmw_service, const void* request, const uint8_t* client_gid,   \
                              int64_t sequence_number, bool taken))                                      \
  FUNCTION(rmw_send_response, (const void* rmw_service, const void* response, const uint8_t* client_gid, \
                               int64_t sequence_number, int64_t timestamp))                              \
  FUNCTION(rmw_client_init, (const void* rmw_client, const uint8_t* gid))                                \
  FUNCTION(rmw_send_request, (const void* rmw_client, const void* request, int64_t sequence_number))     \
  FUNCTION(rmw_take_response, (const void* rmw_client, const void* response, int64_t sequence_number,    \
                               int64_t source_timestamp, bool taken))
#else
#define THEIR_SERVICE_FUNCTIONS(FUNCTION)
#endif

#if THEIR_VERSION >= 810
#define THEIR_LINK_FUNCTIONS(FUNCTION)                                                                            \
  FUNCTION(message_link_periodic_async, (const void** subs, size_t num_subs, const void** pubs, size_t num_pubs)) \
  FUNCTION(message_link_partial_sync, (const void** subs, size_t num_subs, const void** pubs, size_t num_pubs))
#else
#define THEIR_LINK_FUNCTIONS(FUNCTION)
#endif

/* Bytes that rmw has of a gid. */
#if THEIR_VERSION < 501
#define THEIR_GID_SIZE 24
#else
#define THEIR_GID_SIZE 16
#endif

/* From 5.1 on there are two more functions for each event. */
#if THEIR_VERSION >= 501
#define DECLARE_THEIR_FUNCTION(name, parameters) \
  void ros_trace_##name parameters;              \
  bool ros_trace_enabled_##name(void);           \
  void ros_trace_do_##name parameters;
#else
#define DECLARE_THEIR_FUNCTION(name, parameters) void ros_trace_##name parameters;
#endif

#ifdef __cplusplus
extern "C" {
#endif
bool ros_trace_compile_status(void);
#if THEIR_VERSION >= 809
bool ros_trace_runtime_status(void);
#endif
THEIR_FUNCTIONS(DECLARE_THEIR_FUNCTION)
#ifdef __cplusplus
}

namespace tracetools::detail {
#if THEIR_VERSION < 501
const char* demangle_symbol(const char* mangled);
const char* get_symbol_funcptr(void* function);
#else
char* demangle_symbol(const char* mangled);
char* get_symbol_funcptr(const void* function);
#endif
}  // namespace tracetools::detail
#endif
