// SPDX-License-Identifier: Apache-2.0
// Durations of quality-of-service policies and of waits.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "rcutils/time.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_time_s {
  uint64_t sec;
  uint64_t nsec;
} rmw_time_t;

typedef rcutils_time_point_value_t rmw_time_point_value_t;
typedef rcutils_duration_value_t rmw_duration_t;

// The largest 64-bit duration, about 292 years.
#define RMW_DURATION_INFINITE \
  { 9223372036LL, 854775807LL }
#define RMW_DURATION_UNSPECIFIED \
  { 0LL, 0LL }

bool rmw_time_equal(const rmw_time_t left, const rmw_time_t right);

// Nanoseconds; RMW_DURATION_INFINITE if they do not fit.
rmw_duration_t rmw_time_total_nsec(const rmw_time_t time);

// Negative durations become the infinite one.
rmw_time_t rmw_time_from_nsec(const rmw_duration_t nanoseconds);

#ifdef __cplusplus
}
#endif
