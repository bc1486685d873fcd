// SPDX-License-Identifier: Apache-2.0
// The goals of a server, from acceptance to expiry.
#include <algorithm>
#include <optional>

#include "action_end.hpp"
#include "rcl/error_handling.h"

namespace {

bool is_zero(const unique_identifier_msgs__msg__UUID& id) {
  return std::all_of(std::begin(id.uuid), std::end(id.uuid), [](uint8_t byte) { return byte == 0; });
}

bool is_same(const rcl_action_goal_info_t& one, const rcl_action_goal_info_t& other) {
  return uuidcmp(one.goal_id.uuid, other.goal_id.uuid);
}

int64_t nanoseconds(const rcl_action_goal_info_t& info) {
  return int64_t{info.stamp.sec} * 1'000'000'000 + info.stamp.nanosec;
}

rcl_action_goal_info_t info_of(const rcl_action_goal_handle_t* goal) {
  rcl_action_goal_info_t info{};
  (void)rcl_action_goal_handle_get_info(goal, &info);
  return info;
}

rcl_action_goal_handle_t* find(const rcl_action_server_impl_t& impl, const rcl_action_goal_info_t& info) {
  const auto found = std::find_if(impl.goals.begin(), impl.goals.end(),
                                  [&](const rcl_action_goal_handle_t* goal) { return is_same(info_of(goal), info); });
  return found == impl.goals.end() ? nullptr : *found;
}

// Nanoseconds until the result of a goal expires; empty if the goal's end has not been reported yet.
std::optional<int64_t> until_expiry(const rcl_action_server_impl_t& impl, const rcl_action_goal_handle_t* goal,
                                    int64_t now) {
  int64_t ended = -1;
  (void)rcl_action_goal_handle_get_goal_terminal_timestamp(goal, &ended);
  if (ended < 0) {
    return std::nullopt;
  }
  return ended + impl.options.result_timeout.nanoseconds - now;
}

// Sets the timer to the next expiry of a result.
rcl_ret_t set_timer(rcl_action_server_impl_t& impl) {
  if (impl.options.result_timeout.nanoseconds < 0) {
    return RCL_RET_OK;
  }
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(impl.clock, &now); result != RCL_RET_OK) {
    return result;
  }
  int64_t next = -1;
  for (const rcl_action_goal_handle_t* goal : impl.goals) {
    if (const std::optional<int64_t> left = until_expiry(impl, goal, now)) {
      next = next < 0 ? std::max<int64_t>(*left, 0) : std::min(next, std::max<int64_t>(*left, 0));
    }
  }
  if (next < 0) {
    return rcl_timer_cancel(impl.expire_timer);
  }
  int64_t previous = 0;
  if (const rcl_ret_t result = rcl_timer_exchange_period(impl.expire_timer, next, &previous); result != RCL_RET_OK) {
    return result;
  }
  return rcl_timer_reset(impl.expire_timer);
}

}  // namespace

rcl_action_goal_handle_t* rcl_action_accept_new_goal(rcl_action_server_t* action_server,
                                                     const rcl_action_goal_info_t* goal_info) {
  if (!rcl_action_server_is_valid(action_server)) {
    return nullptr;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(goal_info, nullptr);
  rcl_action_server_impl_t& impl = *action_server->impl;
  if (find(impl, *goal_info) != nullptr) {
    RCL_SET_ERROR_MSG("there is a goal of this id already");
    return nullptr;
  }
  rcl_time_point_value_t now = 0;
  if (rcl_clock_get_now(impl.clock, &now) != RCL_RET_OK) {
    return nullptr;
  }
  rcl_action_goal_info_t accepted = *goal_info;
  accepted.stamp.sec = static_cast<int32_t>(now / 1'000'000'000);
  accepted.stamp.nanosec = static_cast<uint32_t>(now % 1'000'000'000);
  auto* goal = new rcl_action_goal_handle_t(rcl_action_get_zero_initialized_goal_handle());
  if (rcl_action_goal_handle_init(goal, &accepted, impl.options.allocator) != RCL_RET_OK) {
    delete goal;
    return nullptr;
  }
  impl.goals.push_back(goal);
  return goal;
}

rcl_ret_t rcl_action_notify_goal_done(const rcl_action_server_t* action_server) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  rcl_action_server_impl_t& impl = *action_server->impl;
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(impl.clock, &now); result != RCL_RET_OK) {
    return result;
  }
  for (rcl_action_goal_handle_t* goal : impl.goals) {
    int64_t ended = -1;
    (void)rcl_action_goal_handle_get_goal_terminal_timestamp(goal, &ended);
    if (ended < 0 && !rcl_action_goal_handle_is_active(goal)) {
      (void)rcl_action_goal_handle_set_goal_terminal_timestamp(goal, now);
    }
  }
  return set_timer(impl);
}

rcl_ret_t rcl_action_expire_goals(const rcl_action_server_t* action_server, rcl_action_goal_info_t* expired_goals,
                                  size_t capacity, size_t* num_expired) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(num_expired, RCL_RET_INVALID_ARGUMENT);
  rcl_action_server_impl_t& impl = *action_server->impl;
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(impl.clock, &now); result != RCL_RET_OK) {
    return result;
  }
  *num_expired = 0;
  const auto is_expired = [&](const rcl_action_goal_handle_t* goal) {
    if (*num_expired == capacity || until_expiry(impl, goal, now).value_or(1) > 0) {
      return false;
    }
    expired_goals[(*num_expired)++] = info_of(goal);
    delete goal;
    return true;
  };
  if (impl.options.result_timeout.nanoseconds >= 0) {
    impl.goals.erase(std::remove_if(impl.goals.begin(), impl.goals.end(), is_expired), impl.goals.end());
  }
  return set_timer(impl);
}

rcl_ret_t rcl_action_server_get_time_until_expiry(const rcl_action_server_t* action_server, int64_t* nanoseconds) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(nanoseconds, RCL_RET_INVALID_ARGUMENT);
  const rcl_ret_t result = rcl_timer_get_time_until_next_call(action_server->impl->expire_timer, nanoseconds);
  if (result == RCL_RET_TIMER_CANCELED) {
    rcl_reset_error();
    *nanoseconds = -1;
    return RCL_RET_OK;
  }
  *nanoseconds = std::max<int64_t>(*nanoseconds, 0);
  return result;
}

rcl_ret_t rcl_action_process_cancel_request(const rcl_action_server_t* action_server,
                                            const rcl_action_cancel_request_t* request,
                                            rcl_action_cancel_response_t* response) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(request, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(response, RCL_RET_INVALID_ARGUMENT);
  const rcl_action_server_impl_t& impl = *action_server->impl;
  const rcl_action_goal_info_t& wanted = request->goal_info;
  const int64_t until = nanoseconds(wanted);
  const bool any_id = is_zero(wanted.goal_id);
  if (const rcl_ret_t result = rcl_action_cancel_response_init(response, impl.goals.size(), impl.options.allocator);
      result != RCL_RET_OK) {
    return result;
  }
  if (!any_id && until == 0) {
    const rcl_action_goal_handle_t* goal = find(impl, wanted);
    if (goal == nullptr) {
      response->msg.return_code = CANCEL_STATE_UNKNOWN_GOAL;
    } else if (!rcl_action_goal_handle_is_cancelable(goal)) {
      response->msg.return_code = CANCEL_STATE_TERMINATED;
    }
  }
  const auto is_meant = [&](const rcl_action_goal_handle_t* goal) {
    const rcl_action_goal_info_t info = info_of(goal);
    const bool by_id = !any_id && is_same(info, wanted);
    const bool by_time = until > 0 ? nanoseconds(info) <= until : any_id;
    return (by_id || by_time) && rcl_action_goal_handle_is_cancelable(goal);
  };
  action_msgs__msg__GoalInfo__Sequence& canceling = response->msg.goals_canceling;
  canceling.size = 0;
  for (const rcl_action_goal_handle_t* goal : impl.goals) {
    if (is_meant(goal)) {
      canceling.data[canceling.size++] = info_of(goal);
    }
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_action_get_goal_status_array(const rcl_action_server_t* action_server,
                                           rcl_action_goal_status_array_t* status_array) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(status_array, RCL_RET_INVALID_ARGUMENT);
  const rcl_action_server_impl_t& impl = *action_server->impl;
  if (const rcl_ret_t result =
          rcl_action_goal_status_array_init(status_array, impl.goals.size(), impl.options.allocator);
      result != RCL_RET_OK) {
    return result;
  }
  rcl_action_goal_status_t* status = status_array->msg.status_list.data;
  for (const rcl_action_goal_handle_t* goal : impl.goals) {
    status->goal_info = info_of(goal);
    (void)rcl_action_goal_handle_get_status(goal, &status->status);
    ++status;
  }
  return RCL_RET_OK;
}

bool rcl_action_server_goal_exists(const rcl_action_server_t* action_server, const rcl_action_goal_info_t* goal_info) {
  return rcl_action_server_is_valid(action_server) && goal_info != nullptr &&
         find(*action_server->impl, *goal_info) != nullptr;
}

rcl_ret_t rcl_action_server_get_goal_handles(const rcl_action_server_t* action_server,
                                             rcl_action_goal_handle_t*** goal_handles, size_t* num_goals) {
  if (!rcl_action_server_is_valid(action_server)) {
    return RCL_RET_ACTION_SERVER_INVALID;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(goal_handles, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(num_goals, RCL_RET_INVALID_ARGUMENT);
  *goal_handles = action_server->impl->goals.data();
  *num_goals = action_server->impl->goals.size();
  return RCL_RET_OK;
}
