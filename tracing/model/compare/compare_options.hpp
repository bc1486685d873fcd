// SPDX-License-Identifier: Apache-2.0
// What a comparison of runs looks at, and how strict it is.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tracing::compare {

struct CompareOptions {
  double confidence = 0.99;        // that none of the changes is there by chance; more than 0.5, less than 1
  double least_ratio = 0.1;        // smaller changes do not count: as a part of the value before,
  std::int64_t least_ns = 20'000;  // and in nanoseconds; the larger one of both applies
};

// The fastest runs of a callback are those that nothing has disturbed, so they tell what the program does.
enum class Statistic { kP10, kMedian, kP90 };

// In the order of Statistic.
inline constexpr const char* kStatisticNames[] = {"p10", "median", "p90"};

constexpr const char* statistic_name(Statistic statistic) {
  return kStatisticNames[static_cast<std::size_t>(statistic)];
}

}  // namespace tracing::compare
