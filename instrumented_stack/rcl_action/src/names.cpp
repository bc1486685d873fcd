// SPDX-License-Identifier: Apache-2.0
#include "rcl_action/names.h"

#include <cstring>
#include <string>

#include "rcl/error_handling.h"
#include "rcl_action/types.h"

namespace {

rcl_ret_t join(const char* action_name, const char* suffix, const rcl_allocator_t& allocator, char** output) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(action_name, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(output, RCL_RET_INVALID_ARGUMENT);
  if (*action_name == '\0') {
    RCL_SET_ERROR_MSG("the name of an action must not be empty");
    return RCL_RET_ACTION_NAME_INVALID;
  }
  const std::string name = std::string(action_name) + suffix;
  char* copy = static_cast<char*>(allocator.allocate(name.size() + 1, allocator.state));
  if (copy == nullptr) {
    RCL_SET_ERROR_MSG("out of memory for a name");
    return RCL_RET_BAD_ALLOC;
  }
  std::memcpy(copy, name.c_str(), name.size() + 1);
  *output = copy;
  return RCL_RET_OK;
}

}  // namespace

rcl_ret_t rcl_action_get_goal_service_name(const char* action_name, rcl_allocator_t allocator,
                                           char** goal_service_name) {
  return join(action_name, "/_action/send_goal", allocator, goal_service_name);
}

rcl_ret_t rcl_action_get_cancel_service_name(const char* action_name, rcl_allocator_t allocator,
                                             char** cancel_service_name) {
  return join(action_name, "/_action/cancel_goal", allocator, cancel_service_name);
}

rcl_ret_t rcl_action_get_result_service_name(const char* action_name, rcl_allocator_t allocator,
                                             char** result_service_name) {
  return join(action_name, "/_action/get_result", allocator, result_service_name);
}

rcl_ret_t rcl_action_get_feedback_topic_name(const char* action_name, rcl_allocator_t allocator,
                                             char** feedback_topic_name) {
  return join(action_name, "/_action/feedback", allocator, feedback_topic_name);
}

rcl_ret_t rcl_action_get_status_topic_name(const char* action_name, rcl_allocator_t allocator,
                                           char** status_topic_name) {
  return join(action_name, "/_action/status", allocator, status_topic_name);
}
