// SPDX-License-Identifier: Apache-2.0
#include "rcl/time.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <vector>

#include "rcl/error_handling.h"

struct rcl_clock_impl_s {
  struct JumpCallback {
    rcl_jump_threshold_t threshold;
    rcl_jump_callback_t function;
    void* user_data;
  };

  std::atomic<bool> simulated{false};
  std::atomic<rcl_time_point_value_t> simulated_now{0};
  std::vector<JumpCallback> jump_callbacks;
};

namespace {

rcl_ret_t check_ros_clock(const rcl_clock_t* clock) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(clock->impl, "the clock is not initialized", return RCL_RET_INVALID_ARGUMENT);
  if (clock->type != RCL_ROS_TIME) {
    RCL_SET_ERROR_MSG("only a clock of ROS time can be given a time");
    return RCL_RET_INVALID_ARGUMENT;
  }
  return RCL_RET_OK;
}

bool concerns(const rcl_jump_threshold_t& threshold, const rcl_time_jump_t& jump) {
  const bool is_change = jump.clock_change == RCL_ROS_TIME_ACTIVATED || jump.clock_change == RCL_ROS_TIME_DEACTIVATED;
  const auto forward = threshold.min_forward.nanoseconds;
  const auto backward = threshold.min_backward.nanoseconds;
  return (is_change && threshold.on_clock_change) || (forward != 0 && jump.delta.nanoseconds >= forward) ||
         (backward != 0 && jump.delta.nanoseconds <= backward);
}

void tell(const rcl_clock_t& clock, const rcl_time_jump_t& jump, bool before_jump) {
  for (const auto& callback : clock.impl->jump_callbacks) {
    if (concerns(callback.threshold, jump)) {
      callback.function(&jump, before_jump, callback.user_data);
    }
  }
}

// Changes the clock. Every callback is called before and after.
template <typename Change>
void jump(const rcl_clock_t& clock, rcl_clock_change_t kind, rcl_duration_value_t delta, Change change) {
  const rcl_time_jump_t description{kind, {delta}};
  tell(clock, description, true);
  change();
  tell(clock, description, false);
}

rcl_ret_t switch_simulation(rcl_clock_t* clock, bool on) {
  if (const rcl_ret_t result = check_ros_clock(clock); result != RCL_RET_OK) {
    return result;
  }
  if (clock->impl->simulated != on) {
    jump(*clock, on ? RCL_ROS_TIME_ACTIVATED : RCL_ROS_TIME_DEACTIVATED, 0, [&] { clock->impl->simulated = on; });
  }
  return RCL_RET_OK;
}

}  // namespace

rcl_ret_t rcl_clock_init(rcl_clock_type_t clock_type, rcl_clock_t* clock, rcl_allocator_t*) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  if (clock_type != RCL_ROS_TIME && clock_type != RCL_SYSTEM_TIME && clock_type != RCL_STEADY_TIME &&
      clock_type != RCL_CLOCK_UNINITIALIZED) {
    RCL_SET_ERROR_MSG("there is no such type of clock");
    return RCL_RET_INVALID_ARGUMENT;
  }
  clock->type = clock_type;
  clock->impl = clock_type == RCL_CLOCK_UNINITIALIZED ? nullptr : new rcl_clock_impl_s;
  return RCL_RET_OK;
}

rcl_ret_t rcl_clock_fini(rcl_clock_t* clock) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  delete clock->impl;
  *clock = {RCL_CLOCK_UNINITIALIZED, nullptr};
  return RCL_RET_OK;
}

bool rcl_clock_valid(rcl_clock_t* clock) {
  return clock != nullptr && clock->type != RCL_CLOCK_UNINITIALIZED && clock->impl != nullptr;
}

rcl_ret_t rcl_clock_get_now(rcl_clock_t* clock, rcl_time_point_value_t* time_point_value) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(time_point_value, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(clock->impl, "the clock is not initialized", return RCL_RET_ERROR);
  if (clock->type == RCL_ROS_TIME && clock->impl->simulated) {
    *time_point_value = clock->impl->simulated_now;
    return RCL_RET_OK;
  }
  return clock->type == RCL_STEADY_TIME ? rcutils_steady_time_now(time_point_value)
                                        : rcutils_system_time_now(time_point_value);
}

rcl_ret_t rcl_difference_times(const rcl_time_point_t* start, const rcl_time_point_t* finish, rcl_duration_t* delta) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(start, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(finish, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(delta, RCL_RET_INVALID_ARGUMENT);
  if (start->clock_type != finish->clock_type) {
    RCL_SET_ERROR_MSG("two times of different clocks have no difference");
    return RCL_RET_ERROR;
  }
  delta->nanoseconds = finish->nanoseconds - start->nanoseconds;
  return RCL_RET_OK;
}

rcl_ret_t rcl_enable_ros_time_override(rcl_clock_t* clock) {
  return switch_simulation(clock, true);
}

rcl_ret_t rcl_disable_ros_time_override(rcl_clock_t* clock) {
  return switch_simulation(clock, false);
}

rcl_ret_t rcl_is_enabled_ros_time_override(rcl_clock_t* clock, bool* is_enabled) {
  if (const rcl_ret_t result = check_ros_clock(clock); result != RCL_RET_OK) {
    return result;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(is_enabled, RCL_RET_INVALID_ARGUMENT);
  *is_enabled = clock->impl->simulated;
  return RCL_RET_OK;
}

rcl_ret_t rcl_set_ros_time_override(rcl_clock_t* clock, rcl_time_point_value_t time_value) {
  if (const rcl_ret_t result = check_ros_clock(clock); result != RCL_RET_OK) {
    return result;
  }
  rcl_clock_impl_t& impl = *clock->impl;
  if (impl.simulated) {
    jump(*clock, RCL_ROS_TIME_NO_CHANGE, time_value - impl.simulated_now, [&] { impl.simulated_now = time_value; });
  } else {
    impl.simulated_now = time_value;
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_clock_add_jump_callback(rcl_clock_t* clock, rcl_jump_threshold_t threshold, rcl_jump_callback_t callback,
                                      void* user_data) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(clock->impl, "the clock is not initialized", return RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(callback, RCL_RET_INVALID_ARGUMENT);
  if (threshold.min_forward.nanoseconds < 0 || threshold.min_backward.nanoseconds > 0) {
    RCL_SET_ERROR_MSG("a jump threshold must not be negative forward or positive backward");
    return RCL_RET_INVALID_ARGUMENT;
  }
  clock->impl->jump_callbacks.push_back({threshold, callback, user_data});
  return RCL_RET_OK;
}

rcl_ret_t rcl_clock_remove_jump_callback(rcl_clock_t* clock, rcl_jump_callback_t callback, void* user_data) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(clock->impl, "the clock is not initialized", return RCL_RET_INVALID_ARGUMENT);
  const auto removed = std::erase_if(clock->impl->jump_callbacks, [&](const auto& known) {
    return known.function == callback && known.user_data == user_data;
  });
  if (removed == 0) {
    RCL_SET_ERROR_MSG("the clock does not have this jump callback");
    return RCL_RET_ERROR;
  }
  return RCL_RET_OK;
}
