// SPDX-License-Identifier: Apache-2.0
#include "base/monotonic_clock.hpp"

#include <gtest/gtest.h>
#include <time.h>

namespace launch {
namespace {

std::int64_t time_of_the_kernel() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

TEST(MonotonicClock, IsTheClockOfTraces) {
  const std::int64_t before = time_of_the_kernel();
  const std::int64_t time = monotonic_time();
  const std::int64_t after = time_of_the_kernel();
  EXPECT_LE(before, time);
  EXPECT_LE(time, after);
}

}  // namespace
}  // namespace launch
