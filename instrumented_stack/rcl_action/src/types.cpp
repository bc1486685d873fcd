// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/types.h"

#include "rcl/error_handling.h"

namespace {

// Gives a sequence of C `size` elements that are zero.
template <typename Sequence>
rcl_ret_t init(Sequence& sequence, size_t size, const rcl_allocator_t& allocator) {
  RCL_CHECK_ALLOCATOR_WITH_MSG(&allocator, "the allocator is invalid", return RCL_RET_INVALID_ARGUMENT);
  if (sequence.data != nullptr) {
    RCL_SET_ERROR_MSG("the message is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  if (size == 0) {
    return RCL_RET_OK;
  }
  void* data = allocator.zero_allocate(size, sizeof *sequence.data, allocator.state);
  if (data == nullptr) {
    RCL_SET_ERROR_MSG("out of memory for the goals of a message");
    return RCL_RET_BAD_ALLOC;
  }
  sequence = {static_cast<decltype(sequence.data)>(data), size, size};
  return RCL_RET_OK;
}

template <typename Sequence>
void fini(Sequence& sequence, const rcl_allocator_t& allocator) {
  if (sequence.data != nullptr) {
    allocator.deallocate(sequence.data, allocator.state);
  }
  sequence = {};
}

}  // namespace

rcl_action_goal_info_t rcl_action_get_zero_initialized_goal_info(void) {
  return {};
}

rcl_action_goal_status_array_t rcl_action_get_zero_initialized_goal_status_array(void) {
  return {};
}

rcl_action_cancel_request_t rcl_action_get_zero_initialized_cancel_request(void) {
  return {};
}

rcl_action_cancel_response_t rcl_action_get_zero_initialized_cancel_response(void) {
  return {};
}

rcl_ret_t rcl_action_goal_status_array_init(rcl_action_goal_status_array_t* status_array, const size_t num_status,
                                            const rcl_allocator_t allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(status_array, RCL_RET_INVALID_ARGUMENT);
  const rcl_ret_t result = init(status_array->msg.status_list, num_status, allocator);
  if (result == RCL_RET_OK) {
    status_array->allocator = allocator;
  }
  return result;
}

rcl_ret_t rcl_action_goal_status_array_fini(rcl_action_goal_status_array_t* status_array) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(status_array, RCL_RET_INVALID_ARGUMENT);
  fini(status_array->msg.status_list, status_array->allocator);
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_cancel_response_init(rcl_action_cancel_response_t* cancel_response,
                                          const size_t num_goals_canceling, const rcl_allocator_t allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(cancel_response, RCL_RET_INVALID_ARGUMENT);
  const rcl_ret_t result = init(cancel_response->msg.goals_canceling, num_goals_canceling, allocator);
  if (result == RCL_RET_OK) {
    cancel_response->msg.return_code = CANCEL_STATE_OK;
    cancel_response->allocator = allocator;
  }
  return result;
}

rcl_ret_t rcl_action_cancel_response_fini(rcl_action_cancel_response_t* cancel_response) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(cancel_response, RCL_RET_INVALID_ARGUMENT);
  fini(cancel_response->msg.goals_canceling, cancel_response->allocator);
  return RCL_RET_OK;
}
