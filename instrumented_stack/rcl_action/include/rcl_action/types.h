// SPDX-License-Identifier: Apache-2.0
// Goals, their states, and the return codes of actions.
#pragma once

#include <string.h>

#include "action_msgs/msg/goal_info.h"
#include "action_msgs/msg/goal_status.h"
#include "action_msgs/msg/goal_status_array.h"
#include "action_msgs/srv/cancel_goal.h"
#include "rcl/allocator.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_RET_ACTION_NAME_INVALID 2000
#define RCL_RET_ACTION_GOAL_ACCEPTED 2100
#define RCL_RET_ACTION_GOAL_REJECTED 2101
#define RCL_RET_ACTION_CLIENT_INVALID 2102
#define RCL_RET_ACTION_CLIENT_TAKE_FAILED 2103
#define RCL_RET_ACTION_SERVER_INVALID 2200
#define RCL_RET_ACTION_SERVER_TAKE_FAILED 2201
#define RCL_RET_ACTION_GOAL_HANDLE_INVALID 2300
#define RCL_RET_ACTION_GOAL_EVENT_INVALID 2301

#define UUID_SIZE 16
#define uuidcmp(uuid0, uuid1) (0 == memcmp((uuid0), (uuid1), UUID_SIZE))

// The goal's id and when it was accepted. All zero in requests means any goal.
typedef action_msgs__msg__GoalInfo rcl_action_goal_info_t;
typedef action_msgs__msg__GoalStatus rcl_action_goal_status_t;

// The states of the goals of a server: its message, and the memory that it has.
typedef struct rcl_action_goal_status_array_s {
  action_msgs__msg__GoalStatusArray msg;
  rcl_allocator_t allocator;
} rcl_action_goal_status_array_t;

// Selects the goals to cancel: this one; with an all zero id every one, or all that were accepted until a time.
typedef action_msgs__srv__CancelGoal_Request rcl_action_cancel_request_t;

// The goals that can be canceled.
typedef struct rcl_action_cancel_response_s {
  action_msgs__srv__CancelGoal_Response msg;
  rcl_allocator_t allocator;
} rcl_action_cancel_response_t;

// The values of action_msgs/GoalStatus.
typedef int8_t rcl_action_goal_state_t;
#define GOAL_STATE_UNKNOWN ((rcl_action_goal_state_t)action_msgs__msg__GoalStatus__STATUS_UNKNOWN)
#define GOAL_STATE_ACCEPTED ((rcl_action_goal_state_t)action_msgs__msg__GoalStatus__STATUS_ACCEPTED)
#define GOAL_STATE_EXECUTING ((rcl_action_goal_state_t)action_msgs__msg__GoalStatus__STATUS_EXECUTING)
#define GOAL_STATE_CANCELING ((rcl_action_goal_state_t)action_msgs__msg__GoalStatus__STATUS_CANCELING)
#define GOAL_STATE_SUCCEEDED ((rcl_action_goal_state_t)action_msgs__msg__GoalStatus__STATUS_SUCCEEDED)
#define GOAL_STATE_CANCELED ((rcl_action_goal_state_t)action_msgs__msg__GoalStatus__STATUS_CANCELED)
#define GOAL_STATE_ABORTED ((rcl_action_goal_state_t)action_msgs__msg__GoalStatus__STATUS_ABORTED)
#define GOAL_STATE_NUM_STATES 7

typedef enum rcl_action_goal_event_e {
  GOAL_EVENT_EXECUTE = 0,
  GOAL_EVENT_CANCEL_GOAL,
  GOAL_EVENT_SUCCEED,
  GOAL_EVENT_ABORT,
  GOAL_EVENT_CANCELED,
  GOAL_EVENT_NUM_EVENTS,
} rcl_action_goal_event_t;

// The values of action_msgs/CancelGoal's return_code.
typedef enum rcl_action_cancel_state_e {
  CANCEL_STATE_OK = 0,
  CANCEL_STATE_REJECTED = 1,
  CANCEL_STATE_UNKNOWN_GOAL = 2,
  CANCEL_STATE_TERMINATED = 3,
} rcl_action_cancel_state_t;

rcl_action_goal_info_t rcl_action_get_zero_initialized_goal_info(void);
rcl_action_goal_status_array_t rcl_action_get_zero_initialized_goal_status_array(void);
rcl_action_cancel_request_t rcl_action_get_zero_initialized_cancel_request(void);
rcl_action_cancel_response_t rcl_action_get_zero_initialized_cancel_response(void);

// Make room for this number of goals, all zero. Return RCL_RET_INVALID_ARGUMENT for a null pointer or an invalid
// allocator, RCL_RET_ALREADY_INIT, RCL_RET_BAD_ALLOC. A number of 0 allocates nothing.
rcl_ret_t rcl_action_goal_status_array_init(rcl_action_goal_status_array_t* status_array, const size_t num_status,
                                            const rcl_allocator_t allocator);
rcl_ret_t rcl_action_cancel_response_init(rcl_action_cancel_response_t* cancel_response,
                                          const size_t num_goals_canceling, const rcl_allocator_t allocator);
rcl_ret_t rcl_action_goal_status_array_fini(rcl_action_goal_status_array_t* status_array);
rcl_ret_t rcl_action_cancel_response_fini(rcl_action_cancel_response_t* cancel_response);

#ifdef __cplusplus
}
#endif
