// SPDX-License-Identifier: Apache-2.0
// The words of a verdict: counts and bounds, and what it says of times that must lie within bounds.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "launch_trace_testing/expectations.hpp"

namespace launch_trace_testing {

// "exactly 3", "at least 1", "at most 5", "2 to 4", "no"
std::string count_text(Count count);
// "10.000 ms to 30.000 ms", "at most 30.000 ms", "at least 10.000 ms", with "for 99 % of them" if not for all
std::string bounds_text(Bounds bounds);

struct Sample {
  std::int64_t ns = 0;
  std::size_t item = 0;  // of the caller: what the time belongs to
};

// "expected: EXPECTED\n     saw: 3 of 40 outside; least 1.000 ms, median 2.000 ms, most 9.000 ms", then what `show`
// makes of the worst samples outside of the bounds, in the order of the samples. There must be a sample.
Verdict verdict_on_samples(const std::string& expected, const std::vector<Sample>& samples, Bounds bounds,
                           const std::function<std::string(const std::vector<Sample>&)>& show);

}  // namespace launch_trace_testing
