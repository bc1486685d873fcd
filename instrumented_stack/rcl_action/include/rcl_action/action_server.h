// SPDX-License-Identifier: Apache-2.0
// The server of an action: three services, two topics, and the goals that it has accepted.
//
// Messages are passed as pointers to the structs of the action's types. The functions on one server may not be called
// from several threads at once.
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
  // How long a goal that came to its end is known, ns; negative for ever. Default 10 s.
  rcl_duration_value_t result_timeout;
} rcl_action_server_options_t;

// Which goals a request to cancel means: this one, or with an all zero id every one, or all accepted until a time.
typedef struct rcl_action_cancel_request_s {
  rcl_action_goal_info_t goal_info;
} rcl_action_cancel_request_t;

typedef struct rcl_action_cancel_response_s {
  rcl_action_cancel_state_t return_code;
  rcl_action_goal_info_t* goals_canceling;  // those that can be canceled; from new[]
  size_t num_goals;
} rcl_action_cancel_response_t;

rcl_action_server_t rcl_action_get_zero_initialized_server(void);
rcl_action_server_options_t rcl_action_server_get_default_options(void);

// Creates the services and topics of `action_name`; the clock tells when goals are accepted and results expire, and
// must outlive the server. RCL_RET_ACTION_NAME_INVALID, RCL_RET_NODE_INVALID, RCL_RET_ALREADY_INIT.
rcl_ret_t rcl_action_server_init(rcl_action_server_t* action_server, rcl_node_t* node, rcl_clock_t* clock,
                                 const rosidl_action_type_support_t* type_support, const char* action_name,
                                 const rcl_action_server_options_t* options);
rcl_ret_t rcl_action_server_fini(rcl_action_server_t* action_server, rcl_node_t* node);

// Requests and responses of the three services. RCL_RET_ACTION_SERVER_TAKE_FAILED when there is none.
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

// Called from any thread with the number of requests that came, null for no call; as for services.
rcl_ret_t rcl_action_server_set_goal_service_callback(const rcl_action_server_t* action_server,
                                                      rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_server_set_cancel_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_server_set_result_service_callback(const rcl_action_server_t* action_server,
                                                        rcl_event_callback_t callback, const void* user_data);

// A new goal in state accepted, owned by the caller, who must fini and delete it once it is no longer among the goals
// of the server. Null if there is a goal of this id already.
rcl_action_goal_handle_t* rcl_action_accept_new_goal(rcl_action_server_t* action_server,
                                                     const rcl_action_goal_info_t* goal_info);

// To be called after a goal came to its end and got its terminal timestamp: it will expire. A goal without one is kept.
rcl_ret_t rcl_action_notify_goal_done(const rcl_action_server_t* action_server);

// Forgets goals whose results have expired; gives at most `capacity` of them.
rcl_ret_t rcl_action_expire_goals(const rcl_action_server_t* action_server, rcl_action_goal_info_t* expired_goals,
                                  size_t capacity, size_t* num_expired);

// Nanoseconds of the server's clock until the next result expires, 0 if one has; -1 if none will.
rcl_ret_t rcl_action_server_get_time_until_expiry(const rcl_action_server_t* action_server, int64_t* nanoseconds);

// Which goals of the server `request` means and can be canceled. Changes no goal. The response must be finalized.
rcl_ret_t rcl_action_process_cancel_request(const rcl_action_server_t* action_server,
                                            const rcl_action_cancel_request_t* request,
                                            rcl_action_cancel_response_t* response);
rcl_ret_t rcl_action_cancel_response_fini(rcl_action_cancel_response_t* response);

bool rcl_action_server_goal_exists(const rcl_action_server_t* action_server, const rcl_action_goal_info_t* goal_info);

// The goals of the server, in memory of the server, valid until the next call on it.
rcl_ret_t rcl_action_server_get_goal_handles(const rcl_action_server_t* action_server,
                                             rcl_action_goal_handle_t*** goal_handles, size_t* num_goals);

// rcl_service_configure_service_introspection() for the three services: requests that were taken and responses that
// were sent. `type_support` is that of the action. After a failure either nothing has changed or it is off.
rcl_ret_t rcl_action_server_configure_action_introspection(rcl_action_server_t* action_server, rcl_node_t* node,
                                                           rcl_clock_t* clock,
                                                           const rosidl_action_type_support_t* type_support,
                                                           const rcl_publisher_options_t publisher_options,
                                                           rcl_service_introspection_state_t introspection_state);

// The name after expansion and remapping is that of the services; this is the one given.
const char* rcl_action_server_get_action_name(const rcl_action_server_t* action_server);
const rcl_action_server_options_t* rcl_action_server_get_options(const rcl_action_server_t* action_server);
bool rcl_action_server_is_valid(const rcl_action_server_t* action_server);
#ifdef __cplusplus
}
#endif
