// SPDX-License-Identifier: Apache-2.0
// Clocks, times and durations.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "rcl/allocator.h"
#include "rcl/types.h"
#include "rcutils/time.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCL_S_TO_NS RCUTILS_S_TO_NS
#define RCL_MS_TO_NS RCUTILS_MS_TO_NS
#define RCL_US_TO_NS RCUTILS_US_TO_NS
#define RCL_NS_TO_S RCUTILS_NS_TO_S
#define RCL_NS_TO_MS RCUTILS_NS_TO_MS
#define RCL_NS_TO_US RCUTILS_NS_TO_US

typedef rcutils_time_point_value_t rcl_time_point_value_t;
typedef rcutils_duration_value_t rcl_duration_value_t;

typedef enum rcl_clock_type_e {
  RCL_CLOCK_UNINITIALIZED = 0,
  RCL_ROS_TIME,     // the system time, or a simulated time that is set from outside
  RCL_SYSTEM_TIME,  // CLOCK_REALTIME
  RCL_STEADY_TIME   // CLOCK_MONOTONIC
} rcl_clock_type_t;

typedef struct rcl_duration_s {
  rcl_duration_value_t nanoseconds;
} rcl_duration_t;

typedef struct rcl_time_point_s {
  rcl_time_point_value_t nanoseconds;
  rcl_clock_type_t clock_type;
} rcl_time_point_t;

typedef enum rcl_clock_change_e {
  RCL_ROS_TIME_NO_CHANGE = 1,  // simulated time moved forward or back
  RCL_ROS_TIME_ACTIVATED = 2,
  RCL_ROS_TIME_DEACTIVATED = 3,
  RCL_SYSTEM_TIME_NO_CHANGE = 4
} rcl_clock_change_t;

typedef struct rcl_time_jump_s {
  rcl_clock_change_t clock_change;
  rcl_duration_t delta;
} rcl_time_jump_t;

// Called once before the clock changes (`before_jump` true) and once after.
typedef void (*rcl_jump_callback_t)(const rcl_time_jump_t* time_jump, bool before_jump, void* user_data);

typedef struct rcl_jump_threshold_s {
  bool on_clock_change;         // also when simulated time is turned on or off
  rcl_duration_t min_forward;   // 0: never on a forward jump
  rcl_duration_t min_backward;  // negative; 0: never on a backward jump
} rcl_jump_threshold_t;

typedef struct rcl_clock_impl_s rcl_clock_impl_t;

typedef struct rcl_clock_s {
  rcl_clock_type_t type;
  rcl_clock_impl_t* impl;
} rcl_clock_t;

rcl_ret_t rcl_clock_init(rcl_clock_type_t clock_type, rcl_clock_t* clock, rcl_allocator_t* allocator);
rcl_ret_t rcl_clock_fini(rcl_clock_t* clock);
bool rcl_clock_valid(rcl_clock_t* clock);

// Nanoseconds since the epoch of the clock. Thread safe.
rcl_ret_t rcl_clock_get_now(rcl_clock_t* clock, rcl_time_point_value_t* time_point_value);

rcl_ret_t rcl_enable_ros_time_override(rcl_clock_t* clock);
rcl_ret_t rcl_disable_ros_time_override(rcl_clock_t* clock);
rcl_ret_t rcl_is_enabled_ros_time_override(rcl_clock_t* clock, bool* is_enabled);
rcl_ret_t rcl_set_ros_time_override(rcl_clock_t* clock, rcl_time_point_value_t time_value);

// `delta` is the time from `start` to `finish`. Returns RCL_RET_ERROR if they are of different clocks.
rcl_ret_t rcl_difference_times(const rcl_time_point_t* start, const rcl_time_point_t* finish, rcl_duration_t* delta);

// Not thread safe: do not call these at the same time as each other or as changes of the clock.
rcl_ret_t rcl_clock_add_jump_callback(rcl_clock_t* clock, rcl_jump_threshold_t threshold, rcl_jump_callback_t callback,
                                      void* user_data);
rcl_ret_t rcl_clock_remove_jump_callback(rcl_clock_t* clock, rcl_jump_callback_t callback, void* user_data);

#ifdef __cplusplus
}
#endif
