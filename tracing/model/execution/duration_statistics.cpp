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
  min_ = count_ == 0 ? other.min_ : std::min(min_, other.min_);
  max_ = count_ == 0 ? other.max_ : std::max(max_, other.max_);
  // Chan, Golub, LeVeque: mean and squared deviations of two samples together.
  const auto ours = static_cast<double>(count_);
  const auto theirs = static_cast<double>(other.count_);
  const double distance = other.mean_ - mean_;
  mean_ += distance * theirs / (ours + theirs);
  squared_deviations_ += other.squared_deviations_ + distance * distance * ours * theirs / (ours + theirs);
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

DurationSummary DurationStatistics::summary() const {
  DurationSummary result;
  if (count_ == 0) {
    return result;
  }
  std::vector<std::int64_t> sorted = kept_;
  std::sort(sorted.begin(), sorted.end());
  result.count = count_;
  result.mean_ns = mean_;
  result.stddev_ns = count_ == 1 ? 0 : std::sqrt(squared_deviations_ / static_cast<double>(count_ - 1));
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
