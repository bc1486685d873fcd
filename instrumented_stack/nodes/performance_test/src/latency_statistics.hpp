// SPDX-License-Identifier: Apache-2.0
// Latencies of messages and their statistics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace performance_test {

// Times in milliseconds; 0 without messages.
struct LatencySummary {
  double min = 0;
  double mean = 0;
  double standard_deviation = 0;
  double median = 0;
  double p90 = 0;
  double p99 = 0;
  double p999 = 0;
  double max = 0;
};

// Takes latencies in ns. A percentile is the smallest latency that at least this share of all does not exceed.
LatencySummary summarize(std::vector<int64_t> latencies_ns);

}  // namespace performance_test
