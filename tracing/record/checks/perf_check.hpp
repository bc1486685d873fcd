// SPDX-License-Identifier: Apache-2.0
// Whether performance counters can be counted here.
#pragma once

#include <string>
#include <vector>

#include "tracing/record/plan/perf_counters.hpp"

namespace tracing {

// Why this process cannot count it (no such hardware counter, no permission), or "" when it can.
std::string why_not_countable(const PerfCounter& counter);

// One for each thread counter that cannot be counted here: LTTng would record no event at all then, without an error.
std::vector<std::string> perf_warnings(const std::vector<std::string>& context_fields_ust);

}  // namespace tracing
