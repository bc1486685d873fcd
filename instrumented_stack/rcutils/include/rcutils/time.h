// SPDX-License-Identifier: Apache-2.0
// Clock readings and durations in integer nanoseconds.
#pragma once

#include <stddef.h>
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
// Like the steady time, but its rate is never adjusted to that of other clocks.
rcutils_ret_t rcutils_raw_steady_time_now(rcutils_time_point_value_t* now);

// These write a time into `str`, cut to `str_size` bytes with the end. They return RCUTILS_RET_INVALID_ARGUMENT for
// null pointers, and write nothing if `str_size` is 0.

// Nanoseconds with 19 digits: "0000000001500000000".
rcutils_ret_t rcutils_time_point_value_as_nanoseconds_string(const rcutils_time_point_value_t* time_point, char* str,
                                                             size_t str_size);

// Seconds with ten digits and nine decimals: "-0000000001.500000000".
rcutils_ret_t rcutils_time_point_value_as_seconds_string(const rcutils_time_point_value_t* time_point, char* str,
                                                         size_t str_size);

// Local time with milliseconds: "2026-01-31 12:00:00.500". The sign is ignored. `str` must have 32 bytes at least.
rcutils_ret_t rcutils_time_point_value_as_date_string(const rcutils_time_point_value_t* time_point, char* str,
                                                      size_t str_size);

#ifdef __cplusplus
}
#endif
