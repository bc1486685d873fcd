// SPDX-License-Identifier: Apache-2.0
// Count, mean, spread and percentiles of durations, in bounded memory.
#pragma once

#include <cstdint>
#include <vector>

namespace tracing {

struct DurationSummary {
  std::uint64_t count = 0;  // the other members have no meaning when it is 0
  double mean_ns = 0;
  double stddev_ns = 0;  // of the sample (n - 1); 0 for a single duration
  std::int64_t min_ns = 0;
  std::int64_t max_ns = 0;
  std::int64_t p50_ns = 0;  // nearest rank: the smallest sample that at least half of all don't exceed
  std::int64_t p90_ns = 0;
  std::int64_t p99_ns = 0;
  bool percentiles_are_exact = true;
};

// All members of the summary are exact, except that the percentiles come from a uniform random sample (Vitter's
// algorithm R) once there are more than kKept durations: p99 is then the true percentile of some rank between 98.8 and
// 99.2 with near certainty. The random sequence is fixed, so that one trace always gives one result.
class DurationStatistics {
 public:
  static constexpr std::size_t kKept = 65'536;  // at 8 bytes: half a MiB at most

  void add(std::int64_t duration_ns);
  DurationSummary summary() const;

 private:
  std::uint64_t next_random();

  std::uint64_t count_ = 0;
  double mean_ = 0;
  double squared_deviations_ = 0;  // Welford's running sum
  std::int64_t min_ = 0;
  std::int64_t max_ = 0;
  std::vector<std::int64_t> kept_;
  std::uint64_t random_state_ = 0;
};

}  // namespace tracing
