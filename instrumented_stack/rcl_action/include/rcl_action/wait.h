// SPDX-License-Identifier: Apache-2.0
// Waits for servers and clients of actions.
#pragma once

#include "rcl/wait.h"
#include "rcl_action/action_client.h"
#include "rcl_action/action_server.h"

#ifdef __cplusplus
extern "C" {
#endif

// The number of entities that the server, or client, has in a wait set.
rcl_ret_t rcl_action_server_wait_set_get_num_entities(const rcl_action_server_t* action_server,
                                                      size_t* num_subscriptions, size_t* num_guard_conditions,
                                                      size_t* num_timers, size_t* num_clients, size_t* num_services);
rcl_ret_t rcl_action_client_wait_set_get_num_entities(const rcl_action_client_t* action_client,
                                                      size_t* num_subscriptions, size_t* num_guard_conditions,
                                                      size_t* num_timers, size_t* num_clients, size_t* num_services);

// An index (may be null) gets the place of the first of the services, clients or subscriptions. Returns
// RCL_RET_WAIT_SET_FULL if there is no room.
rcl_ret_t rcl_action_wait_set_add_action_server(rcl_wait_set_t* wait_set, const rcl_action_server_t* action_server,
                                                size_t* service_index);
rcl_ret_t rcl_action_wait_set_add_action_client(rcl_wait_set_t* wait_set, const rcl_action_client_t* action_client,
                                                size_t* client_index, size_t* subscription_index);

// The entities that are ready after rcl_wait().
rcl_ret_t rcl_action_server_wait_set_get_entities_ready(const rcl_wait_set_t* wait_set,
                                                        const rcl_action_server_t* action_server,
                                                        bool* is_goal_request_ready, bool* is_cancel_request_ready,
                                                        bool* is_result_request_ready, bool* is_goal_expired);
rcl_ret_t rcl_action_client_wait_set_get_entities_ready(const rcl_wait_set_t* wait_set,
                                                        const rcl_action_client_t* action_client,
                                                        bool* is_feedback_ready, bool* is_status_ready,
                                                        bool* is_goal_response_ready, bool* is_cancel_response_ready,
                                                        bool* is_result_response_ready);
#ifdef __cplusplus
}
#endif
