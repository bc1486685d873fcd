// SPDX-License-Identifier: Apache-2.0
// What the measured programs tell the benchmark.
#pragma once

#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace node_start {

inline std::int64_t now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

// In nanoseconds.
struct Ready {
  std::int64_t main_begun;      // CLOCK_MONOTONIC
  std::int64_t ready;           // CLOCK_MONOTONIC
  std::int64_t processor_time;  // of the process until then
};

// To standard output.
inline void tell_ready(std::int64_t main_begun) {
  const Ready ready = {main_begun, now(CLOCK_MONOTONIC), now(CLOCK_PROCESS_CPUTIME_ID)};
  if (write(STDOUT_FILENO, &ready, sizeof ready) != sizeof ready) {
    std::exit(EXIT_FAILURE);
  }
}

}  // namespace node_start
