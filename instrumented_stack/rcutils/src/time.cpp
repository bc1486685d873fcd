// SPDX-License-Identifier: Apache-2.0
#include "rcutils/time.h"

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

}  // namespace

rcutils_ret_t rcutils_system_time_now(rcutils_time_point_value_t* now) {
  return read_clock(CLOCK_REALTIME, now);
}

rcutils_ret_t rcutils_steady_time_now(rcutils_time_point_value_t* now) {
  return read_clock(CLOCK_MONOTONIC, now);
}
