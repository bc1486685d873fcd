// SPDX-License-Identifier: Apache-2.0
// Count, mean, spread and percentiles of durations, in bounded memory.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
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
  std::int64_t p999_ns = 0;   // 99.9 %
  std::int64_t p9999_ns = 0;  // 99.99 %
};

// All members of the summary are exact, except the percentiles of more than kKept durations: they come from a histogram
// whose buckets are 1/256 of their values wide, and are the middle of a bucket. So they differ from the true percentile
// by at most 0.2 %.
class DurationStatistics {
 public:
  static constexpr std::size_t kKept = 4'096;

  void add(std::int64_t duration_ns) {
    ++count_;
    const auto value = static_cast<Wide>(duration_ns);
    sum_ += value;
    squares_ += static_cast<UnsignedWide>(value * value);
    if (duration_ns < min_) [[unlikely]] {
      min_ = duration_ns;
    }
    if (duration_ns > max_) [[unlikely]] {
      max_ = duration_ns;
    }
    const std::size_t bucket = bucket_of(duration_ns);
    if (bucket < histogram_.size()) {
      ++histogram_[bucket];
    } else {
      keep(duration_ns);
    }
  }
  void add(const DurationStatistics& other);
  DurationSummary summary() const;
  std::uint64_t count() const { return count_; }

 private:
  // Buckets of equal width up to twice this value, then as many buckets for each doubling of the value.
  static constexpr unsigned kBits = 8;
  static constexpr std::uint64_t kBucketsOfADoubling = std::uint64_t{1} << kBits;
  static std::size_t bucket_of(std::int64_t duration_ns) {
    if (duration_ns < static_cast<std::int64_t>(kBucketsOfADoubling)) {
      return static_cast<std::size_t>(std::max<std::int64_t>(duration_ns, 0));
    }
    // A floating-point number has the number of the doubling, and behind it the first bits of the place within.
    constexpr unsigned kBitsOfPlace = std::numeric_limits<double>::digits - 1;
    constexpr std::size_t kFirst = (std::numeric_limits<double>::max_exponent - 2 + kBits) << kBits;
    const auto number = std::bit_cast<std::uint64_t>(static_cast<double>(duration_ns));
    return (number >> (kBitsOfPlace - kBits)) - kFirst;
  }
  // The value in the middle of a bucket.
  static std::int64_t middle_of(std::size_t bucket);

  void keep(std::int64_t duration_ns);
  void make_histogram();
  void count_in_histogram(std::int64_t duration_ns);
  std::int64_t percentile(std::uint64_t per_ten_thousand, const std::vector<std::int64_t>& sorted) const;

  double deviation() const;

  // Sums of whole numbers need no division for each duration, and lose nothing.
  __extension__ using Wide = __int128;
  __extension__ using UnsignedWide = unsigned __int128;
  std::uint64_t count_ = 0;
  std::int64_t min_ = std::numeric_limits<std::int64_t>::max();
  Wide sum_ = 0;
  UnsignedWide squares_ = 0;
  std::int64_t max_ = std::numeric_limits<std::int64_t>::min();
  std::vector<std::uint32_t> histogram_;  // empty as long as there are few; grows to the largest duration
  std::vector<std::int64_t> kept_;        // all durations, as long as there are few
};

}  // namespace tracing
