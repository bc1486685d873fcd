// SPDX-License-Identifier: Apache-2.0
// Counts and bounds in words, for the first line of a verdict.
#pragma once

#include <string>

#include "launch_trace_testing/expectations.hpp"

namespace launch_trace_testing {

// "exactly 3", "at least 1", "at most 5", "2 to 4", "no"
std::string count_text(Count count);
// "10.000 ms to 30.000 ms", "at most 30.000 ms", "at least 10.000 ms", with "for 99 % of them" if not for all
std::string bounds_text(Bounds bounds);

}  // namespace launch_trace_testing
