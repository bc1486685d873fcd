// SPDX-License-Identifier: Apache-2.0
#include "rcutils/time.h"

#include <cinttypes>
#include <cstdio>
#include <ctime>

#include "rcutils/error_handling.h"

namespace {

rcutils_ret_t read_clock(clockid_t clock, rcutils_time_point_value_t* now) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(now, RCUTILS_RET_INVALID_ARGUMENT);
  timespec time;
  if (clock_gettime(clock, &time) != 0) {
    RCUTILS_SET_ERROR_MSG("the clock cannot be read");
    return RCUTILS_RET_ERROR;
  }
  *now = RCUTILS_S_TO_NS(static_cast<int64_t>(time.tv_sec)) + time.tv_nsec;
  return RCUTILS_RET_OK;
}

constexpr uint64_t kSecond = RCUTILS_S_TO_NS(1);

// The least time has no positive counterpart in int64_t.
uint64_t magnitude(rcutils_time_point_value_t time) {
  return time < 0 ? -static_cast<uint64_t>(time) : static_cast<uint64_t>(time);
}

}  // namespace

rcutils_ret_t rcutils_system_time_now(rcutils_time_point_value_t* now) {
  return read_clock(CLOCK_REALTIME, now);
}

rcutils_ret_t rcutils_steady_time_now(rcutils_time_point_value_t* now) {
  return read_clock(CLOCK_MONOTONIC, now);
}

rcutils_ret_t rcutils_raw_steady_time_now(rcutils_time_point_value_t* now) {
  return read_clock(CLOCK_MONOTONIC_RAW, now);
}

rcutils_ret_t rcutils_time_point_value_as_nanoseconds_string(const rcutils_time_point_value_t* time_point, char* str,
                                                             size_t str_size) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(time_point, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(str, RCUTILS_RET_INVALID_ARGUMENT);
  std::snprintf(str, str_size, "%.19" PRId64, *time_point);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_time_point_value_as_seconds_string(const rcutils_time_point_value_t* time_point, char* str,
                                                         size_t str_size) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(time_point, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(str, RCUTILS_RET_INVALID_ARGUMENT);
  const uint64_t time = magnitude(*time_point);
  std::snprintf(str, str_size, "%s%.10" PRIu64 ".%.9" PRIu64, *time_point < 0 ? "-" : "", time / kSecond,
                time % kSecond);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_time_point_value_as_date_string(const rcutils_time_point_value_t* time_point, char* str,
                                                      size_t str_size) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(time_point, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(str, RCUTILS_RET_INVALID_ARGUMENT);
  if (str_size == 0) {
    return RCUTILS_RET_OK;
  }
  const uint64_t time = magnitude(*time_point);
  const auto seconds = static_cast<time_t>(time / kSecond);
  tm local;
  char date[32];
  if (str_size < sizeof(date) || localtime_r(&seconds, &local) == nullptr ||
      std::strftime(date, sizeof(date), "%Y-%m-%d %H:%M:%S", &local) == 0) {
    RCUTILS_SET_ERROR_MSG("the date of a time can't be written: it needs 32 bytes");
    return RCUTILS_RET_ERROR;
  }
  std::snprintf(str, str_size, "%s.%.3" PRIu64, date, time % kSecond / 1000000);
  return RCUTILS_RET_OK;
}
