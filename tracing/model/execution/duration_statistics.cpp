// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/duration_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace tracing {

std::int64_t DurationStatistics::middle_of(std::size_t bucket) {
  if (bucket < 2 * kBucketsOfADoubling) {
    return static_cast<std::int64_t>(bucket);
  }
  const auto shift = static_cast<unsigned>(bucket / kBucketsOfADoubling - 1);
  const std::uint64_t lowest = (bucket % kBucketsOfADoubling + kBucketsOfADoubling) << shift;
  return static_cast<std::int64_t>(lowest + (std::uint64_t{1} << (shift - 1)));
}

void DurationStatistics::keep(std::int64_t duration_ns) {
  if (count_ <= kKept) {
    kept_.push_back(duration_ns);
    return;
  }
  make_histogram();
  count_in_histogram(duration_ns);
}

void DurationStatistics::make_histogram() {
  if (!histogram_.empty()) {
    return;
  }
  for (const std::int64_t kept : kept_) {
    count_in_histogram(kept);
  }
  kept_ = {};
}

void DurationStatistics::add(const DurationStatistics& other) {
  if (other.histogram_.empty()) {
    for (const std::int64_t duration : other.kept_) {
      add(duration);
    }
    return;
  }
  make_histogram();
  if (histogram_.size() < other.histogram_.size()) {
    histogram_.resize(other.histogram_.size());
  }
  for (std::size_t bucket = 0; bucket < other.histogram_.size(); ++bucket) {
    histogram_[bucket] += other.histogram_[bucket];
  }
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
  sum_ += other.sum_;
  squares_ += other.squares_;
  count_ += other.count_;
}

void DurationStatistics::count_in_histogram(std::int64_t duration_ns) {
  const std::size_t bucket = bucket_of(duration_ns);
  if (bucket >= histogram_.size()) {
    histogram_.resize(bucket + 1);
  }
  ++histogram_[bucket];
}

std::int64_t DurationStatistics::percentile(std::uint64_t per_ten_thousand,
                                            const std::vector<std::int64_t>& sorted) const {
  const std::uint64_t rank = (count_ * per_ten_thousand + 9'999) / 10'000;  // rounded up, from 1
  if (histogram_.empty()) {
    return sorted[rank - 1];
  }
  std::uint64_t below = 0;
  std::size_t bucket = 0;
  while (below + histogram_[bucket] < rank) {
    below += histogram_[bucket++];
  }
  return std::clamp(middle_of(bucket), min_, max_);
}

// Of the sample. The squares of the distances from the mean are few against those of the values, so whole numbers do
// all that can be done with them: they are taken from the mean rounded down, and the rest of it is left for the end.
double DurationStatistics::deviation() const {
  if (count_ < 2) {
    return 0;
  }
  const auto count = static_cast<Wide>(count_);
  const Wide mean = sum_ / count;
  const Wide rest = sum_ % count;
  const UnsignedWide squares = squares_ - static_cast<UnsignedWide>(mean) * static_cast<UnsignedWide>(sum_ + rest);
  const auto of_rest =
      static_cast<long double>(rest) * static_cast<long double>(rest) / static_cast<long double>(count);
  const long double squared = (static_cast<long double>(squares) - of_rest) / static_cast<long double>(count - 1);
  return static_cast<double>(std::sqrt(std::max(squared, 0.0L)));
}

DurationSummary DurationStatistics::summary() const {
  DurationSummary result;
  if (count_ == 0) {
    return result;
  }
  std::vector<std::int64_t> sorted = kept_;
  std::sort(sorted.begin(), sorted.end());
  result.count = count_;
  result.mean_ns = static_cast<double>(static_cast<long double>(sum_) / static_cast<long double>(count_));
  result.stddev_ns = deviation();
  result.min_ns = min_;
  result.max_ns = max_;
  result.p50_ns = percentile(5'000, sorted);
  result.p90_ns = percentile(9'000, sorted);
  result.p99_ns = percentile(9'900, sorted);
  result.p999_ns = percentile(9'990, sorted);
  result.p9999_ns = percentile(9'999, sorted);
  result.percentiles_are_exact = histogram_.empty();
  return result;
}

}  // namespace tracing
