// SPDX-License-Identifier: Apache-2.0
#include "latency_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace performance_test {

namespace {

double milliseconds(double nanoseconds) {
  return nanoseconds * 1e-6;
}

}  // namespace

LatencySummary summarize(std::vector<int64_t> latencies_ns) {
  LatencySummary summary;
  if (latencies_ns.empty()) {
    return summary;
  }
  std::sort(latencies_ns.begin(), latencies_ns.end());
  const auto count = static_cast<double>(latencies_ns.size());
  double sum = 0;
  for (const int64_t latency : latencies_ns) {
    sum += static_cast<double>(latency);
  }
  const double mean = sum / count;
  double squares = 0;
  for (const int64_t latency : latencies_ns) {
    squares += (static_cast<double>(latency) - mean) * (static_cast<double>(latency) - mean);
  }
  const auto percentile = [&](double share) {
    const auto rank = static_cast<size_t>(std::ceil(share * count));
    return milliseconds(static_cast<double>(latencies_ns[std::max<size_t>(rank, 1) - 1]));
  };
  summary.min = milliseconds(static_cast<double>(latencies_ns.front()));
  summary.mean = milliseconds(mean);
  summary.standard_deviation = milliseconds(std::sqrt(squares / count));
  summary.median = percentile(0.5);
  summary.p90 = percentile(0.9);
  summary.p99 = percentile(0.99);
  summary.p999 = percentile(0.999);
  summary.max = milliseconds(static_cast<double>(latencies_ns.back()));
  return summary;
}

}  // namespace performance_test
