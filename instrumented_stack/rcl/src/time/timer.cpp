// SPDX-License-Identifier: Apache-2.0
#include "rcl/timer.h"

#include <atomic>
#include <memory>
#include <mutex>

#include "rcl/error_handling.h"
#include "tracetools/tracetools.h"

struct rcl_timer_impl_s {
  rcl_clock_t* clock;
  rcl_guard_condition_t guard_condition = rcl_get_zero_initialized_guard_condition();
  rcl_timer_callback_t callback;
  std::atomic<int64_t> period;
  std::atomic<int64_t> last_call_time;
  std::atomic<int64_t> next_call_time;
  std::atomic<bool> canceled;
  // Time left until the next call when simulated time is turned on or off. It carries over to the new time.
  std::atomic<int64_t> time_left{0};
  std::mutex on_reset_mutex{};
  bool is_told_of_jumps = false;
  rcl_event_callback_t on_reset = nullptr;
  const void* on_reset_user_data = nullptr;
};

namespace {

// Any jump of simulated time can make a timer due, or move its next call too far away.
constexpr rcl_jump_threshold_t kEveryJump = {true, {1}, {-1}};

// A waiting thread has already computed its timeout, so wake it.
rcl_ret_t wake_waiting(rcl_timer_impl_t& timer, bool is_jump = false) {
  {
    const std::lock_guard lock(timer.on_reset_mutex);
    if (timer.on_reset != nullptr && (!is_jump || timer.is_told_of_jumps)) {
      timer.on_reset(timer.on_reset_user_data, 1);
    }
  }
  return rcl_trigger_guard_condition(&timer.guard_condition);
}

bool is_switch(const rcl_time_jump_t& jump) {
  return jump.clock_change == RCL_ROS_TIME_ACTIVATED || jump.clock_change == RCL_ROS_TIME_DEACTIVATED;
}

void on_time_jump(const rcl_time_jump_t* jump, bool before_jump, void* user_data) {
  rcl_timer_impl_t& timer = *static_cast<rcl_timer_impl_t*>(user_data);
  rcl_time_point_value_t now = 0;
  if (rcl_clock_get_now(timer.clock, &now) != RCL_RET_OK) {
    rcl_reset_error();
    return;
  }
  if (before_jump) {
    if (is_switch(*jump)) {
      timer.time_left = timer.next_call_time - now;
    }
    return;
  }
  if (is_switch(*jump)) {
    timer.next_call_time = now + timer.time_left;
    timer.last_call_time = timer.next_call_time - timer.period;
  } else if (now < timer.last_call_time) {
    timer.last_call_time = now;
    timer.next_call_time = now + timer.period;
  }
  if (wake_waiting(timer, true) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

rcl_ret_t check(const rcl_timer_t* timer) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(timer, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(timer->impl, "the timer is not initialized", return RCL_RET_TIMER_INVALID);
  return RCL_RET_OK;
}

rcl_ret_t set_callback(const rcl_timer_t* timer, rcl_event_callback_t callback, const void* user_data,
                       bool is_told_of_jumps) {
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  const std::lock_guard lock(timer->impl->on_reset_mutex);
  timer->impl->on_reset = callback;
  timer->impl->on_reset_user_data = user_data;
  timer->impl->is_told_of_jumps = is_told_of_jumps;
  return RCL_RET_OK;
}

// The first time after `now` that is a whole number of periods after `due`.
int64_t next_call_after(int64_t due, int64_t now, int64_t period) {
  const int64_t next = due + period;
  if (next > now) {
    return next;
  }
  return period == 0 ? now : next + ((now - next) / period + 1) * period;
}

}  // namespace

rcl_timer_t rcl_get_zero_initialized_timer(void) {
  return {};
}

rcl_ret_t rcl_timer_init(rcl_timer_t* timer, rcl_clock_t* clock, rcl_context_t* context, int64_t period,
                         const rcl_timer_callback_t callback, rcl_allocator_t allocator) {
  return rcl_timer_init2(timer, clock, context, period, callback, allocator, true);
}

rcl_ret_t rcl_timer_init2(rcl_timer_t* timer, rcl_clock_t* clock, rcl_context_t* context, int64_t period,
                          const rcl_timer_callback_t callback, rcl_allocator_t, bool autostart) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(timer, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  if (period < 0) {
    RCL_SET_ERROR_MSG("a timer period must not be negative");
    return RCL_RET_INVALID_ARGUMENT;
  }
  if (timer->impl != nullptr) {
    RCL_SET_ERROR_MSG("the timer is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(clock, &now); result != RCL_RET_OK) {
    return result;
  }
  std::unique_ptr<rcl_timer_impl_t> impl(new rcl_timer_impl_t{.clock = clock,
                                                              .callback = callback,
                                                              .period = period,
                                                              .last_call_time = now,
                                                              .next_call_time = now + period,
                                                              .canceled = !autostart});
  if (const rcl_ret_t result =
          rcl_guard_condition_init(&impl->guard_condition, context, rcl_guard_condition_get_default_options());
      result != RCL_RET_OK) {
    return result;
  }
  if (clock->type == RCL_ROS_TIME) {
    if (const rcl_ret_t result = rcl_clock_add_jump_callback(clock, kEveryJump, on_time_jump, impl.get());
        result != RCL_RET_OK) {
      (void)rcl_guard_condition_fini(&impl->guard_condition);
      return result;
    }
  }
  timer->impl = impl.release();
  TRACETOOLS_TRACEPOINT(rcl_timer_init, static_cast<const void*>(timer), period);
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_fini(rcl_timer_t* timer) {
  if (timer == nullptr || timer->impl == nullptr) {
    return RCL_RET_OK;
  }
  TRACETOOLS_EXT_TRACEPOINT(rcl_timer_fini, static_cast<const void*>(timer));
  rcl_timer_impl_t* impl = timer->impl;
  timer->impl = nullptr;
  rcl_ret_t result = RCL_RET_OK;
  if (impl->clock->type == RCL_ROS_TIME) {
    result = rcl_clock_remove_jump_callback(impl->clock, on_time_jump, impl);
  }
  (void)rcl_guard_condition_fini(&impl->guard_condition);
  delete impl;
  return result;
}

rcl_ret_t rcl_timer_call(rcl_timer_t* timer) {
  rcl_timer_call_info_t ignored;
  return rcl_timer_call_with_info(timer, &ignored);
}

rcl_ret_t rcl_timer_call_with_info(rcl_timer_t* timer, rcl_timer_call_info_t* call_info) {
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(call_info, RCL_RET_INVALID_ARGUMENT);
  rcl_timer_impl_t& impl = *timer->impl;
  if (impl.canceled) {
    RCL_SET_ERROR_MSG("the timer is canceled");
    return RCL_RET_TIMER_CANCELED;
  }
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(impl.clock, &now); result != RCL_RET_OK) {
    return result;
  }
  const int64_t due = impl.next_call_time;
  const int64_t previous = impl.last_call_time.exchange(now);
  impl.next_call_time = next_call_after(due, now, impl.period);
  *call_info = {due, now};
  if (impl.callback != nullptr) {
    impl.callback(timer, now - previous);
  }
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_clock(const rcl_timer_t* timer, rcl_clock_t** clock) {
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(clock, RCL_RET_INVALID_ARGUMENT);
  *clock = timer->impl->clock;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_is_ready(const rcl_timer_t* timer, bool* is_ready) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(is_ready, RCL_RET_INVALID_ARGUMENT);
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  *is_ready = false;
  if (timer->impl->canceled) {
    return RCL_RET_OK;
  }
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(timer->impl->clock, &now); result != RCL_RET_OK) {
    return result;
  }
  *is_ready = timer->impl->next_call_time <= now;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_get_time_until_next_call(const rcl_timer_t* timer, int64_t* time_until_next_call) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(time_until_next_call, RCL_RET_INVALID_ARGUMENT);
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  if (timer->impl->canceled) {
    return RCL_RET_TIMER_CANCELED;
  }
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(timer->impl->clock, &now); result != RCL_RET_OK) {
    return result;
  }
  *time_until_next_call = timer->impl->next_call_time - now;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_get_next_call_time(const rcl_timer_t* timer, int64_t* next_call_time) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(next_call_time, RCL_RET_INVALID_ARGUMENT);
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  if (timer->impl->canceled) {
    return RCL_RET_TIMER_CANCELED;
  }
  *next_call_time = timer->impl->next_call_time;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_get_time_since_last_call(const rcl_timer_t* timer, rcl_time_point_value_t* time_since_last_call) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(time_since_last_call, RCL_RET_INVALID_ARGUMENT);
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(timer->impl->clock, &now); result != RCL_RET_OK) {
    return result;
  }
  *time_since_last_call = now - timer->impl->last_call_time;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_get_period(const rcl_timer_t* timer, int64_t* period) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(period, RCL_RET_INVALID_ARGUMENT);
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  *period = timer->impl->period;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_exchange_period(const rcl_timer_t* timer, int64_t new_period, int64_t* old_period) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(old_period, RCL_RET_INVALID_ARGUMENT);
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  if (new_period < 0) {
    RCL_SET_ERROR_MSG("a timer period must not be negative");
    return RCL_RET_INVALID_ARGUMENT;
  }
  *old_period = timer->impl->period.exchange(new_period);
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_cancel(rcl_timer_t* timer) {
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  timer->impl->canceled = true;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_is_canceled(const rcl_timer_t* timer, bool* is_canceled) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(is_canceled, RCL_RET_INVALID_ARGUMENT);
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  *is_canceled = timer->impl->canceled;
  return RCL_RET_OK;
}

rcl_ret_t rcl_timer_reset(rcl_timer_t* timer) {
  if (const rcl_ret_t result = check(timer); result != RCL_RET_OK) {
    return result;
  }
  rcl_time_point_value_t now = 0;
  if (const rcl_ret_t result = rcl_clock_get_now(timer->impl->clock, &now); result != RCL_RET_OK) {
    return result;
  }
  timer->impl->next_call_time = now + timer->impl->period;
  timer->impl->canceled = false;
  return wake_waiting(*timer->impl);
}

rcl_ret_t rcl_timer_set_on_reset_callback(const rcl_timer_t* timer, rcl_event_callback_t callback,
                                          const void* user_data) {
  return set_callback(timer, callback, user_data, false);
}

rcl_ret_t rcl_timer_set_on_change_callback(const rcl_timer_t* timer, rcl_event_callback_t callback,
                                           const void* user_data) {
  return set_callback(timer, callback, user_data, true);
}

rcl_guard_condition_t* rcl_timer_get_guard_condition(const rcl_timer_t* timer) {
  return check(timer) == RCL_RET_OK ? &timer->impl->guard_condition : nullptr;
}
