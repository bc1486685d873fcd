// SPDX-License-Identifier: Apache-2.0
// The states of a goal on its server.
#pragma once

#include "rcl_action/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// The state after `event`; GOAL_STATE_UNKNOWN if the event is not allowed in `state`.
rcl_action_goal_state_t rcl_action_transition_goal_state(rcl_action_goal_state_t state, rcl_action_goal_event_t event);
#ifdef __cplusplus
}
#endif
