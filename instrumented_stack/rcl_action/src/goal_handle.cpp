// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/goal_handle.h"

#include <atomic>

#include "rcl/error_handling.h"
#include "rcl_action/goal_state_machine.h"

struct rcl_action_goal_handle_impl_s {
  explicit rcl_action_goal_handle_impl_s(const rcl_action_goal_info_t& goal_info) : info(goal_info) {}

  const rcl_action_goal_info_t info;
  std::atomic<rcl_action_goal_state_t> state{GOAL_STATE_ACCEPTED};
  std::atomic<int64_t> terminal_timestamp{-1};
};

namespace {

constexpr const char* kStateNames[] = {"unknown",   "accepted", "executing", "canceling",
                                       "succeeded", "canceled", "aborted"};
constexpr const char* kEventNames[] = {"begin to execute", "begin to be canceled", "succeed", "abort", "be canceled",
                                       "do that"};

}  // namespace

rcl_action_goal_state_t rcl_action_transition_goal_state(rcl_action_goal_state_t state, rcl_action_goal_event_t event) {
  switch (event) {
    case GOAL_EVENT_EXECUTE:
      return state == GOAL_STATE_ACCEPTED ? GOAL_STATE_EXECUTING : GOAL_STATE_UNKNOWN;
    case GOAL_EVENT_CANCEL_GOAL:
      return state == GOAL_STATE_ACCEPTED || state == GOAL_STATE_EXECUTING ? GOAL_STATE_CANCELING : GOAL_STATE_UNKNOWN;
    case GOAL_EVENT_SUCCEED:
      return state == GOAL_STATE_EXECUTING || state == GOAL_STATE_CANCELING ? GOAL_STATE_SUCCEEDED : GOAL_STATE_UNKNOWN;
    case GOAL_EVENT_ABORT:
      return state == GOAL_STATE_EXECUTING || state == GOAL_STATE_CANCELING ? GOAL_STATE_ABORTED : GOAL_STATE_UNKNOWN;
    case GOAL_EVENT_CANCELED:
      return state == GOAL_STATE_CANCELING ? GOAL_STATE_CANCELED : GOAL_STATE_UNKNOWN;
    case GOAL_EVENT_NUM_EVENTS:
      break;
  }
  return GOAL_STATE_UNKNOWN;
}

rcl_action_goal_handle_t rcl_action_get_zero_initialized_goal_handle(void) {
  return {};
}

rcl_ret_t rcl_action_goal_handle_init(rcl_action_goal_handle_t* goal_handle, const rcl_action_goal_info_t* goal_info,
                                      rcl_allocator_t) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(goal_handle, RCL_RET_ACTION_GOAL_HANDLE_INVALID);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(goal_info, RCL_RET_INVALID_ARGUMENT);
  if (goal_handle->impl != nullptr) {
    RCL_SET_ERROR_MSG("the goal handle is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  goal_handle->impl = new rcl_action_goal_handle_impl_s(*goal_info);
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_goal_handle_fini(rcl_action_goal_handle_t* goal_handle) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(goal_handle, RCL_RET_ACTION_GOAL_HANDLE_INVALID);
  delete goal_handle->impl;
  goal_handle->impl = nullptr;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_update_goal_state(rcl_action_goal_handle_t* goal_handle, rcl_action_goal_event_t goal_event) {
  if (!rcl_action_goal_handle_is_valid(goal_handle)) {
    return RCL_RET_ACTION_GOAL_HANDLE_INVALID;
  }
  rcl_action_goal_state_t state = goal_handle->impl->state;
  rcl_action_goal_state_t next = GOAL_STATE_UNKNOWN;
  do {
    next = rcl_action_transition_goal_state(state, goal_event);
    if (next == GOAL_STATE_UNKNOWN) {
      RCL_SET_ERROR_MSG_WITH_FORMAT_STRING("a goal that is %s cannot %s", kStateNames[state], kEventNames[goal_event]);
      return RCL_RET_ACTION_GOAL_EVENT_INVALID;
    }
  } while (!goal_handle->impl->state.compare_exchange_weak(state, next));
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_goal_handle_get_info(const rcl_action_goal_handle_t* goal_handle,
                                          rcl_action_goal_info_t* goal_info) {
  if (!rcl_action_goal_handle_is_valid(goal_handle)) {
    return RCL_RET_ACTION_GOAL_HANDLE_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(goal_info, RCL_RET_INVALID_ARGUMENT);
  *goal_info = goal_handle->impl->info;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_goal_handle_get_status(const rcl_action_goal_handle_t* goal_handle,
                                            rcl_action_goal_state_t* status) {
  if (!rcl_action_goal_handle_is_valid(goal_handle)) {
    return RCL_RET_ACTION_GOAL_HANDLE_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(status, RCL_RET_INVALID_ARGUMENT);
  *status = goal_handle->impl->state;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_goal_handle_get_goal_terminal_timestamp(const rcl_action_goal_handle_t* goal_handle,
                                                             int64_t* timestamp) {
  if (!rcl_action_goal_handle_is_valid(goal_handle)) {
    return RCL_RET_ACTION_GOAL_HANDLE_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(timestamp, RCL_RET_INVALID_ARGUMENT);
  *timestamp = goal_handle->impl->terminal_timestamp;
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_goal_handle_set_goal_terminal_timestamp(const rcl_action_goal_handle_t* goal_handle,
                                                             int64_t timestamp) {
  if (!rcl_action_goal_handle_is_valid(goal_handle)) {
    return RCL_RET_ACTION_GOAL_HANDLE_INVALID;
  }
  goal_handle->impl->terminal_timestamp = timestamp;
  return RCL_RET_OK;
}

bool rcl_action_goal_handle_is_active(const rcl_action_goal_handle_t* goal_handle) {
  if (!rcl_action_goal_handle_is_valid(goal_handle)) {
    return false;
  }
  const rcl_action_goal_state_t state = goal_handle->impl->state;
  return state == GOAL_STATE_ACCEPTED || state == GOAL_STATE_EXECUTING || state == GOAL_STATE_CANCELING;
}

bool rcl_action_goal_handle_is_cancelable(const rcl_action_goal_handle_t* goal_handle) {
  return rcl_action_goal_handle_is_valid(goal_handle) &&
         rcl_action_transition_goal_state(goal_handle->impl->state, GOAL_EVENT_CANCEL_GOAL) == GOAL_STATE_CANCELING;
}

bool rcl_action_goal_handle_is_abortable(const rcl_action_goal_handle_t* goal_handle) {
  return rcl_action_goal_handle_is_valid(goal_handle) &&
         rcl_action_transition_goal_state(goal_handle->impl->state, GOAL_EVENT_ABORT) == GOAL_STATE_ABORTED;
}

bool rcl_action_goal_handle_is_valid(const rcl_action_goal_handle_t* goal_handle) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(goal_handle, "the goal handle is null", return false);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(goal_handle->impl, "the goal handle is not initialized", return false);
  return true;
}
