// SPDX-License-Identifier: Apache-2.0
// A timer on a clock. It is due at equal intervals; the code that waits for it calls it.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "rcl/allocator.h"
#include "rcl/context.h"
#include "rcl/event_callback.h"
#include "rcl/guard_condition.h"
#include "rcl/time.h"
#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_timer_impl_s rcl_timer_impl_t;

typedef struct rcl_timer_s {
  rcl_timer_impl_t* impl;
} rcl_timer_t;

// The time at which a call was due and the time at which it happened, in ns of the timer's clock.
typedef struct rcl_timer_call_info_s {
  rcl_time_point_value_t expected_call_time;
  rcl_time_point_value_t actual_call_time;
} rcl_timer_call_info_t;

// `last_call_time`: nanoseconds between this and the previous call.
typedef void (*rcl_timer_callback_t)(rcl_timer_t* timer, int64_t last_call_time);

rcl_timer_t rcl_get_zero_initialized_timer(void);

// `period` is in ns; 0 is always ready. The callback may be null. With `autostart` false the timer starts cancelled.
// Fires rcl_timer_init. The clock must outlive the timer.
rcl_ret_t rcl_timer_init2(rcl_timer_t* timer, rcl_clock_t* clock, rcl_context_t* context, int64_t period,
                          const rcl_timer_callback_t callback, rcl_allocator_t allocator, bool autostart);

// Like rcl_timer_init2() with `autostart` true.
rcl_ret_t rcl_timer_init(rcl_timer_t* timer, rcl_clock_t* clock, rcl_context_t* context, int64_t period,
                         const rcl_timer_callback_t callback, rcl_allocator_t allocator);
rcl_ret_t rcl_timer_fini(rcl_timer_t* timer);

// Sets the next call to a future time, a whole number of periods after the due one, and runs the callback. Does not
// check whether the timer is due. Returns RCL_RET_TIMER_CANCELED for a cancelled timer. Two threads must not call it
// for the same timer.
rcl_ret_t rcl_timer_call(rcl_timer_t* timer);
rcl_ret_t rcl_timer_call_with_info(rcl_timer_t* timer, rcl_timer_call_info_t* call_info);

rcl_ret_t rcl_timer_clock(const rcl_timer_t* timer, rcl_clock_t** clock);
rcl_ret_t rcl_timer_is_ready(const rcl_timer_t* timer, bool* is_ready);

// Nanoseconds; negative if overdue. Returns RCL_RET_TIMER_CANCELED for a cancelled timer.
rcl_ret_t rcl_timer_get_time_until_next_call(const rcl_timer_t* timer, int64_t* time_until_next_call);
rcl_ret_t rcl_timer_get_next_call_time(const rcl_timer_t* timer, int64_t* next_call_time);
rcl_ret_t rcl_timer_get_time_since_last_call(const rcl_timer_t* timer, rcl_time_point_value_t* time_since_last_call);
rcl_ret_t rcl_timer_get_period(const rcl_timer_t* timer, int64_t* period);
rcl_ret_t rcl_timer_exchange_period(const rcl_timer_t* timer, int64_t new_period, int64_t* old_period);
rcl_ret_t rcl_timer_cancel(rcl_timer_t* timer);
rcl_ret_t rcl_timer_is_canceled(const rcl_timer_t* timer, bool* is_canceled);

// The next call is one period from now; a cancelled timer runs again.
rcl_ret_t rcl_timer_reset(rcl_timer_t* timer);

// Triggered by a reset or a jump of simulated time, so that a wait set computes its timeout again. Owned by the timer.
rcl_guard_condition_t* rcl_timer_get_guard_condition(const rcl_timer_t* timer);

// `callback` is called for every reset. It serves code that waits for timers without a wait set. Null ends the calls:
// none is running any more when this returns. Must not be called from the callback.
rcl_ret_t rcl_timer_set_on_reset_callback(const rcl_timer_t* timer, rcl_event_callback_t callback,
                                          const void* user_data);
// Replaces that callback by one that is also called for every jump of simulated time, because it may make the timer
// due. Not in ROS 2, where such code asks the clock for jumps.
rcl_ret_t rcl_timer_set_on_change_callback(const rcl_timer_t* timer, rcl_event_callback_t callback,
                                           const void* user_data);

#ifdef __cplusplus
}
#endif
