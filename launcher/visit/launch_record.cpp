// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/launch_record.hpp"

#include <chrono>

namespace launch {

std::int64_t monotonic_time() {
  // On Linux the steady clock is CLOCK_MONOTONIC.
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace launch
