// SPDX-License-Identifier: Apache-2.0
// The names of the services and topics that carry an action.
#pragma once

#include "rcl/allocator.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Each returns `<action_name>/_action/...` in memory of the allocator, which the caller frees. Returns
// RCL_RET_ACTION_NAME_INVALID for an empty name.
rcl_ret_t rcl_action_get_goal_service_name(const char* action_name, rcl_allocator_t allocator,
                                           char** goal_service_name);
rcl_ret_t rcl_action_get_cancel_service_name(const char* action_name, rcl_allocator_t allocator,
                                             char** cancel_service_name);
rcl_ret_t rcl_action_get_result_service_name(const char* action_name, rcl_allocator_t allocator,
                                             char** result_service_name);
rcl_ret_t rcl_action_get_feedback_topic_name(const char* action_name, rcl_allocator_t allocator,
                                             char** feedback_topic_name);
rcl_ret_t rcl_action_get_status_topic_name(const char* action_name, rcl_allocator_t allocator,
                                           char** status_topic_name);
#ifdef __cplusplus
}
#endif
