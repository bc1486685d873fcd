// SPDX-License-Identifier: Apache-2.0
// The server of an action: three services, two topics, and the goals that it has accepted.
//
// Messages are passed as pointers to the structs of the action's types. Only one thread at a time may use a server.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "rcl/allocator.h"
#include "rcl/event_callback.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service_introspection.h"
#include "rcl/time.h"
#include "rcl/timer.h"
#include "rcl_action/goal_handle.h"
#include "rcl_action/types.h"
#include "rosidl_runtime_c/action_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_action_server_impl_s rcl_action_server_impl_t;

typedef struct rcl_action_server_s {
  rcl_action_server_impl_t* impl;
} rcl_action_server_t;

typedef struct rcl_action_server_options_s {
  rmw_qos_profile_t goal_service_qos;
  rmw_qos_profile_t cancel_service_qos;
  rmw_qos_profile_t result_service_qos;
  rmw_qos_profile_t feedback_topic_qos;
  rmw_qos_profile_t status_topic_qos;
  rcl_allocator_t allocator;
  // How long an ended goal is kept; negative: forever. Default 10 s.
  rcl_duration_t result_timeout;
} rcl_action_server_options_t;

rcl_action_server_t rcl_action_get_zero_initialized_server(void);
rcl_action_server_options_t rcl_action_server_get_default_options(void);

// Creates the services and topics of `action_name`. The clock tells when goals are accepted and results expire, and
// must outlive the server. Returns RCL_RET_ACTION_NAME_INVALID, RCL_RET_NODE_INVALID or RCL_RET_ALREADY_INIT on errors.
rcl_ret_t rcl_action_server_init(rcl_action_server_t* action_server, rcl_node_t* node, rcl_clock_t* clock,
                                 const rosidl_action_type_support_t* type_support, const char* action_name,
                                 const rcl_action_server_options_t* options);
// The same with a timer of the caller instead of one of its own. The server sets its period for each result that
// expires; the caller waits for it and then calls rcl_action_expire_goals(). The timer must outlive the server.
rcl_ret_t rcl_action_server_init2(rcl_action_server_t* action_server, rcl_node_t* node, rcl_timer_t* expire_timer,
                                  const rosidl_action_type_support_t* type_support, const char* action_name,
                                  const rcl_action_server_options_t* options);
rcl_ret_t rcl_action_server_fini(rcl_action_server_t* action_server, rcl_node_t* node);

// Requests and responses of the three services. Return RCL_RET_ACTION_SERVER_TAKE_FAILED if there is no request.
rcl_ret_t rcl_action_take_goal_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                       void* ros_goal_request);
rcl_ret_t rcl_action_send_goal_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                        void* ros_goal_response);
rcl_ret_t rcl_action_take_cancel_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                         void* ros_cancel_request);
rcl_ret_t rcl_action_send_cancel_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                          void* ros_cancel_response);
rcl_ret_t rcl_action_take_result_request(const rcl_action_server_t* action_server, rmw_request_id_t* request_header,
                                         void* ros_result_request);
rcl_ret_t rcl_action_send_result_response(const rcl_action_server_t* action_server, rmw_request_id_t* response_header,
                                          void* ros_result_response);

rcl_ret_t rcl_action_publish_feedback(const rcl_action_server_t* action_server, void* ros_feedback);
rcl_ret_t rcl_action_publish_status(const rcl_action_server_t* action_server, const void* ros_status_array);

// Called from any thread with the number of new requests, as for services. Null ends the calls.
rcl_ret_t rcl_action_server_set_goal_service_callback(const rcl_action_server_t* action_server,
                                                      rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_server_set_cancel_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_server_set_result_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data);

// Creates a goal in state accepted, which must be finalized once it is no longer among the goals of the server. The
// structure belongs to the server and lives until the goal expires or the server ends: copy it. Returns null if a goal
// with this id exists already.
rcl_action_goal_handle_t* rcl_action_accept_new_goal(rcl_action_server_t* action_server,
                                                     const rcl_action_goal_info_t* goal_info);

// Call it after a goal has ended; then it will expire. Goals that have ended and have no terminal timestamp get the
// current time. A goal without a timestamp is kept.
rcl_ret_t rcl_action_notify_goal_done(const rcl_action_server_t* action_server);

// Forgets goals whose results have expired, and returns at most `capacity` of them.
rcl_ret_t rcl_action_expire_goals(const rcl_action_server_t* action_server, rcl_action_goal_info_t* expired_goals,
                                  size_t capacity, size_t* num_expired);

// Nanoseconds of the server's clock until the next result expires; 0 if one has expired, -1 if none will.
rcl_ret_t rcl_action_server_get_time_until_expiry(const rcl_action_server_t* action_server, int64_t* nanoseconds);

// Finds the goals that `request` selects and that can be canceled. Changes no goal. The response must be zero
// initialized, and be finalized afterwards.
rcl_ret_t rcl_action_process_cancel_request(const rcl_action_server_t* action_server,
                                            const rcl_action_cancel_request_t* request,
                                            rcl_action_cancel_response_t* response);

// The states of all goals of the server. The array must be zero initialized, and be finalized afterwards.
rcl_ret_t rcl_action_get_goal_status_array(const rcl_action_server_t* action_server,
                                           rcl_action_goal_status_array_t* status_array);

bool rcl_action_server_goal_exists(const rcl_action_server_t* action_server, const rcl_action_goal_info_t* goal_info);

// The goals of the server. The memory belongs to the server and is valid until the next call on it.
rcl_ret_t rcl_action_server_get_goal_handles(const rcl_action_server_t* action_server,
                                             rcl_action_goal_handle_t*** goal_handles, size_t* num_goals);

// Applies rcl_service_configure_service_introspection() to the three services: requests taken and responses sent.
// `type_support` is that of the action. On failure either nothing has changed, or introspection is off.
rcl_ret_t rcl_action_server_configure_action_introspection(rcl_action_server_t* action_server, rcl_node_t* node,
                                                           rcl_clock_t* clock,
                                                           const rosidl_action_type_support_t* type_support,
                                                           const rcl_publisher_options_t publisher_options,
                                                           rcl_service_introspection_state_t introspection_state);

// The name as given. The services use the expanded and remapped name.
const char* rcl_action_server_get_action_name(const rcl_action_server_t* action_server);
const rcl_action_server_options_t* rcl_action_server_get_options(const rcl_action_server_t* action_server);
bool rcl_action_server_is_valid(const rcl_action_server_t* action_server);
#ifdef __cplusplus
}
#endif
