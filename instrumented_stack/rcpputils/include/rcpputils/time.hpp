// SPDX-License-Identifier: Apache-2.0
// Converts durations for functions that count in nanoseconds.
#pragma once

#include <chrono>
#include <limits>
#include <stdexcept>

namespace rcpputils {

// Throws std::invalid_argument if nanoseconds cannot hold the duration.
template <typename RepT, typename RatioT>
std::chrono::nanoseconds convert_to_nanoseconds(const std::chrono::duration<RepT, RatioT>& time) {
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::duration<long double, std::nano>>(time).count();
  if (nanoseconds > static_cast<long double>(std::chrono::nanoseconds::max().count()) ||
      nanoseconds < static_cast<long double>(std::chrono::nanoseconds::min().count())) {
    throw std::invalid_argument("time is out of the range of std::chrono::nanoseconds");
  }
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time);
}

}  // namespace rcpputils
