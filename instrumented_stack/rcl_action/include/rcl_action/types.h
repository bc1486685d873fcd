// SPDX-License-Identifier: Apache-2.0
// Goals, their states, and the return codes of actions.
#pragma once

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

// The contents of action_msgs/GoalInfo: the goal's id and when it was accepted. All zero in requests means any goal.
typedef struct rcl_action_goal_info_s {
  uint8_t goal_id[UUID_SIZE];
  int32_t stamp_sec;
  uint32_t stamp_nanosec;
} rcl_action_goal_info_t;

// The values of action_msgs/GoalStatus.
typedef enum rcl_action_goal_state_e {
  GOAL_STATE_UNKNOWN = 0,
  GOAL_STATE_ACCEPTED = 1,
  GOAL_STATE_EXECUTING = 2,
  GOAL_STATE_CANCELING = 3,
  GOAL_STATE_SUCCEEDED = 4,
  GOAL_STATE_CANCELED = 5,
  GOAL_STATE_ABORTED = 6,
  GOAL_STATE_MAX = 7,
} rcl_action_goal_state_t;

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
#ifdef __cplusplus
}
#endif
