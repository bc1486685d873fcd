// SPDX-License-Identifier: Apache-2.0
// The client of an action: three clients of its services, and subscriptions to its two topics.
//
// Messages are passed as pointers to the structs of the action's types.
#pragma once

#include <stdbool.h>

#include "rcl/allocator.h"
#include "rcl/event_callback.h"
#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service_introspection.h"
#include "rcl/time.h"
#include "rcl_action/types.h"
#include "rosidl_runtime_c/action_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_action_client_impl_s rcl_action_client_impl_t;

typedef struct rcl_action_client_s {
  rcl_action_client_impl_t* impl;
} rcl_action_client_t;

typedef struct rcl_action_client_options_s {
  rmw_qos_profile_t goal_service_qos;
  rmw_qos_profile_t result_service_qos;
  rmw_qos_profile_t cancel_service_qos;
  rmw_qos_profile_t feedback_topic_qos;
  rmw_qos_profile_t status_topic_qos;
  rcl_allocator_t allocator;
} rcl_action_client_options_t;

rcl_action_client_t rcl_action_get_zero_initialized_client(void);
rcl_action_client_options_t rcl_action_client_get_default_options(void);

// Returns RCL_RET_ACTION_NAME_INVALID, RCL_RET_NODE_INVALID or RCL_RET_ALREADY_INIT on errors.
rcl_ret_t rcl_action_client_init(rcl_action_client_t* action_client, rcl_node_t* node,
                                 const rosidl_action_type_support_t* type_support, const char* action_name,
                                 const rcl_action_client_options_t* options);
rcl_ret_t rcl_action_client_fini(rcl_action_client_t* action_client, rcl_node_t* node);

// Whether this client has discovered all three services and both publishers of a server.
rcl_ret_t rcl_action_server_is_available(const rcl_node_t* node, const rcl_action_client_t* client, bool* is_available);

// `sequence_number` gets the number that the response will carry.
rcl_ret_t rcl_action_send_goal_request(const rcl_action_client_t* action_client, const void* ros_goal_request,
                                       int64_t* sequence_number);
rcl_ret_t rcl_action_send_cancel_request(const rcl_action_client_t* action_client, const void* ros_cancel_request,
                                         int64_t* sequence_number);
rcl_ret_t rcl_action_send_result_request(const rcl_action_client_t* action_client, const void* ros_result_request,
                                         int64_t* sequence_number);

// Returns RCL_RET_ACTION_CLIENT_TAKE_FAILED if there is nothing to take.
rcl_ret_t rcl_action_take_goal_response(const rcl_action_client_t* action_client, rmw_request_id_t* response_header,
                                        void* ros_goal_response);
rcl_ret_t rcl_action_take_cancel_response(const rcl_action_client_t* action_client, rmw_request_id_t* response_header,
                                          void* ros_cancel_response);
rcl_ret_t rcl_action_take_result_response(const rcl_action_client_t* action_client, rmw_request_id_t* response_header,
                                          void* ros_result_response);
rcl_ret_t rcl_action_take_feedback(const rcl_action_client_t* action_client, void* ros_feedback);
rcl_ret_t rcl_action_take_status(const rcl_action_client_t* action_client, void* ros_status_array);

// Called from any thread with the number of new messages, as for clients and subscriptions. Null ends the calls.
rcl_ret_t rcl_action_client_set_goal_client_callback(const rcl_action_client_t* action_client,
                                                     rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_client_set_cancel_client_callback(const rcl_action_client_t* action_client,
                                                       rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_client_set_result_client_callback(const rcl_action_client_t* action_client,
                                                       rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_client_set_feedback_subscription_callback(const rcl_action_client_t* action_client,
                                                               rcl_event_callback_t callback, const void* user_data);
rcl_ret_t rcl_action_client_set_status_subscription_callback(const rcl_action_client_t* action_client,
                                                             rcl_event_callback_t callback, const void* user_data);

// Applies rcl_client_configure_service_introspection() to the three services: requests sent and responses taken.
// `type_support` is that of the action. On failure either nothing has changed, or introspection is off.
rcl_ret_t rcl_action_client_configure_action_introspection(rcl_action_client_t* action_client, rcl_node_t* node,
                                                           rcl_clock_t* clock,
                                                           const rosidl_action_type_support_t* type_support,
                                                           const rcl_publisher_options_t publisher_options,
                                                           rcl_service_introspection_state_t introspection_state);

const char* rcl_action_client_get_action_name(const rcl_action_client_t* action_client);
const rcl_action_client_options_t* rcl_action_client_get_options(const rcl_action_client_t* action_client);
bool rcl_action_client_is_valid(const rcl_action_client_t* action_client);
#ifdef __cplusplus
}
#endif
