// SPDX-License-Identifier: Apache-2.0
// Clock readings and durations in integer nanoseconds.
#pragma once

#include <stdint.h>

#include "rcutils/types/rcutils_ret.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_S_TO_NS(seconds) ((seconds) * (1000LL * 1000LL * 1000LL))
#define RCUTILS_MS_TO_NS(milliseconds) ((milliseconds) * (1000LL * 1000LL))
#define RCUTILS_US_TO_NS(microseconds) ((microseconds)*1000LL)
#define RCUTILS_NS_TO_S(nanoseconds) ((nanoseconds) / (1000LL * 1000LL * 1000LL))
#define RCUTILS_NS_TO_MS(nanoseconds) ((nanoseconds) / (1000LL * 1000LL))
#define RCUTILS_NS_TO_US(nanoseconds) ((nanoseconds) / 1000LL)

// Nanoseconds since the epoch of the clock: 1970 for the system clock, some past moment for the steady one.
typedef int64_t rcutils_time_point_value_t;
typedef int64_t rcutils_duration_value_t;

// CLOCK_REALTIME.
rcutils_ret_t rcutils_system_time_now(rcutils_time_point_value_t* now);

// CLOCK_MONOTONIC.
rcutils_ret_t rcutils_steady_time_now(rcutils_time_point_value_t* now);

#ifdef __cplusplus
}
#endif
