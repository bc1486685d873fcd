// SPDX-License-Identifier: Apache-2.0
// Creates the parts of an action with their names.
#pragma once

#include "rcl/allocator.h"
#include "rcl_action/types.h"

namespace rcl_action {

using MakeName = rcl_ret_t (*)(const char* action_name, rcl_allocator_t allocator, char** name);

// Calls `init` with the result of `make_name`. A wrong name is reported as the action's name.
template <typename Init>
rcl_ret_t init_named(MakeName make_name, const char* action_name, const rcl_allocator_t& allocator, Init init) {
  char* name = nullptr;
  if (const rcl_ret_t result = make_name(action_name, allocator, &name); result != RCL_RET_OK) {
    return result;
  }
  const rcl_ret_t result = init(name);
  allocator.deallocate(name, allocator.state);
  const bool name_is_wrong = result == RCL_RET_SERVICE_NAME_INVALID || result == RCL_RET_TOPIC_NAME_INVALID;
  return name_is_wrong ? RCL_RET_ACTION_NAME_INVALID : result;
}

}  // namespace rcl_action
