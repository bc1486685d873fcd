// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/duration_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace tracing {

void DurationStatistics::add(std::int64_t duration_ns) {
  ++count_;
  const double value = static_cast<double>(duration_ns);
  const double deviation = value - mean_;
  mean_ += deviation / static_cast<double>(count_);
  squared_deviations_ += deviation * (value - mean_);
  min_ = count_ == 1 ? duration_ns : std::min(min_, duration_ns);
  max_ = count_ == 1 ? duration_ns : std::max(max_, duration_ns);
  if (kept_.size() < kKept) {
    kept_.push_back(duration_ns);
  } else if (const std::uint64_t slot = next_random() % count_; slot < kKept) {
    kept_[slot] = duration_ns;
  }
}

DurationSummary DurationStatistics::summary() const {
  DurationSummary result;
  if (count_ == 0) return result;
  std::vector<std::int64_t> sorted = kept_;
  std::sort(sorted.begin(), sorted.end());
  const auto percentile = [&sorted](std::size_t percent) {
    const std::size_t rank = (sorted.size() * percent + 99) / 100;  // rounded up, from 1
    return sorted[rank - 1];
  };
  result.count = count_;
  result.mean_ns = mean_;
  result.stddev_ns = count_ == 1 ? 0 : std::sqrt(squared_deviations_ / static_cast<double>(count_ - 1));
  result.min_ns = min_;
  result.max_ns = max_;
  result.p50_ns = percentile(50);
  result.p90_ns = percentile(90);
  result.p99_ns = percentile(99);
  result.percentiles_are_exact = count_ <= kKept;
  return result;
}

// splitmix64 (Steele, Lea, Flood 2014): one state word per statistic instead of mt19937's 2.5 kB.
std::uint64_t DurationStatistics::next_random() {
  std::uint64_t z = (random_state_ += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace tracing
