// SPDX-License-Identifier: Apache-2.0
// The clock by which traces, timers and records of a launch count time: CLOCK_MONOTONIC, as LTTng's own time stamps.
#pragma once

#include <chrono>
#include <cstdint>

namespace launch {

// Nanoseconds since some fixed point of this boot. All processes of a machine agree on it.
inline std::int64_t monotonic_time() {
  // On Linux the steady clock of both C++ libraries is CLOCK_MONOTONIC, read without a system call.
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace launch
