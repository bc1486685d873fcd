// SPDX-License-Identifier: Apache-2.0
// A goal on its server. Between init and fini its functions may be called from any thread.
#pragma once

#include <stdbool.h>

#include "rcl/allocator.h"
#include "rcl_action/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_action_goal_handle_impl_s rcl_action_goal_handle_impl_t;

typedef struct rcl_action_goal_handle_s {
  rcl_action_goal_handle_impl_t* impl;
} rcl_action_goal_handle_t;

rcl_action_goal_handle_t rcl_action_get_zero_initialized_goal_handle(void);

// Creates a goal in state accepted. Returns RCL_RET_ALREADY_INIT if it is initialized already.
rcl_ret_t rcl_action_goal_handle_init(rcl_action_goal_handle_t* goal_handle, const rcl_action_goal_info_t* goal_info,
                                      rcl_allocator_t allocator);
rcl_ret_t rcl_action_goal_handle_fini(rcl_action_goal_handle_t* goal_handle);

// Returns RCL_RET_ACTION_GOAL_EVENT_INVALID and changes nothing if the event is not allowed in the goal's state.
rcl_ret_t rcl_action_update_goal_state(rcl_action_goal_handle_t* goal_handle, rcl_action_goal_event_t goal_event);

rcl_ret_t rcl_action_goal_handle_get_info(const rcl_action_goal_handle_t* goal_handle,
                                          rcl_action_goal_info_t* goal_info);
rcl_ret_t rcl_action_goal_handle_get_status(const rcl_action_goal_handle_t* goal_handle,
                                            rcl_action_goal_state_t* status);

// The time at which the goal ended, in ns of the server's clock; -1 before that.
rcl_ret_t rcl_action_goal_handle_get_goal_terminal_timestamp(const rcl_action_goal_handle_t* goal_handle,
                                                             int64_t* timestamp);
rcl_ret_t rcl_action_goal_handle_set_goal_terminal_timestamp(const rcl_action_goal_handle_t* goal_handle,
                                                             int64_t timestamp);

// Whether the goal is accepted, executing or canceling.
bool rcl_action_goal_handle_is_active(const rcl_action_goal_handle_t* goal_handle);
bool rcl_action_goal_handle_is_cancelable(const rcl_action_goal_handle_t* goal_handle);
bool rcl_action_goal_handle_is_abortable(const rcl_action_goal_handle_t* goal_handle);
bool rcl_action_goal_handle_is_valid(const rcl_action_goal_handle_t* goal_handle);
#ifdef __cplusplus
}
#endif
