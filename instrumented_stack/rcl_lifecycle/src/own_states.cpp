// SPDX-License-Identifier: Apache-2.0
// States and transitions that a program makes for itself.
#include "rcl/error_handling.h"
#include "rcl_lifecycle/rcl_lifecycle.h"
#include "rcutils/strdup.h"

namespace {

void free_label(const char*& label, const rcl_allocator_t& allocator) {
  if (label != nullptr) {
    allocator.deallocate(const_cast<char*>(label), allocator.state);
    label = nullptr;
  }
}

void free_state(const rcl_lifecycle_state_t*& state, const rcl_allocator_t& allocator) {
  if (state != nullptr) {
    auto* const owned = const_cast<rcl_lifecycle_state_t*>(state);
    free_label(owned->label, allocator);
    allocator.deallocate(owned, allocator.state);
    state = nullptr;
  }
}

}  // namespace

rcl_lifecycle_state_t rcl_lifecycle_get_zero_initialized_state(void) {
  return {};
}

rcl_lifecycle_transition_t rcl_lifecycle_get_zero_initialized_transition(void) {
  return {};
}

rcl_ret_t rcl_lifecycle_state_init(rcl_lifecycle_state_t* state, unsigned int id, const char* label,
                                   const rcl_allocator_t* allocator) {
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(allocator, "invalid allocator", return RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(state, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(label, RCL_RET_INVALID_ARGUMENT);
  state->id = id;
  state->label = rcutils_strdup(label, *allocator);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(state->label, "no memory for the label of a state", return RCL_RET_ERROR);
  return RCL_RET_OK;
}

rcl_ret_t rcl_lifecycle_state_fini(rcl_lifecycle_state_t* state, const rcl_allocator_t* allocator) {
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(allocator, "invalid allocator", return RCL_RET_INVALID_ARGUMENT);
  if (state != nullptr) {
    free_label(state->label, *allocator);
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_lifecycle_transition_init(rcl_lifecycle_transition_t* transition, unsigned int id, const char* label,
                                        rcl_lifecycle_state_t* start, rcl_lifecycle_state_t* goal,
                                        const rcl_allocator_t* allocator) {
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(allocator, "invalid allocator", return RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(transition, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(label, RCL_RET_INVALID_ARGUMENT);
  *transition = {rcutils_strdup(label, *allocator), id, start, goal};
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(transition->label, "no memory for the label of a transition", return RCL_RET_ERROR);
  return RCL_RET_OK;
}

rcl_ret_t rcl_lifecycle_transition_fini(rcl_lifecycle_transition_t* transition, const rcl_allocator_t* allocator) {
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(allocator, "invalid allocator", return RCL_RET_INVALID_ARGUMENT);
  if (transition != nullptr) {
    const bool is_loop = transition->start == transition->goal;
    free_state(transition->start, *allocator);
    if (is_loop) {
      transition->goal = nullptr;
    }
    free_state(transition->goal, *allocator);
    free_label(transition->label, *allocator);
  }
  return RCL_RET_OK;
}
