// SPDX-License-Identifier: Apache-2.0
// Runs that were never recorded, for comparisons. The random numbers have fixed seeds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include "tracing/model/compare/comparison.hpp"

namespace tracing::compare {

inline constexpr int kCallbacks = 50;
inline constexpr int kSamples = 250;
inline constexpr double kMicrosecond = 1e3;
inline constexpr double kMillisecond = 1e6;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double normal() {  // nearly: the sum of twelve uniform numbers
    double sum = -6;
    for (int i = 0; i < 12; ++i) {
      sum += uniform();
    }
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

inline Measurement measurement(const std::string& subject, const std::function<double(int)>& value,
                               int samples = kSamples) {
  Measurement one{Kind::kCallback, subject, "duration", {}, static_cast<std::uint64_t>(samples), {}, false};
  for (int i = 0; i < samples; ++i) {
    one.samples.push_back(std::llround(std::max(value(i), 1.0)));
  }
  return one;
}

// Durations of 50 us to 1 ms that resemble their neighbours, with outliers. `changed` gets what `change` adds.
inline RunSummary run(std::uint64_t seed, int changed = -1, const std::function<double(int)>& change = {}) {
  Random random(seed);
  RunSummary run;
  for (int number = 0; number < kCallbacks; ++number) {
    const double usual = (50 + 19 * number) * kMicrosecond;
    double slow = 0;
    run.measurements.push_back(measurement("/node_" + std::to_string(number), [&](int i) {
      slow = 0.9 * slow + 0.1 * random.normal();
      const double outlier = random.uniform() < 0.03 ? 3 * kMillisecond * random.uniform() : 0;
      return usual * (1 + 0.2 * slow + 0.02 * random.normal()) + outlier + (number == changed ? change(i) : 0);
    }));
  }
  return run;
}

inline Comparison compared(RunSummary before, RunSummary after, const CompareOptions& options = {}) {
  return compare({"before", {std::move(before)}}, {"after", {std::move(after)}}, options);
}

}  // namespace tracing::compare
