// SPDX-License-Identifier: Apache-2.0
// Names of Linux performance counters, as in perf-list(1) and lttng-add-context(1), to perf_event_open(2)'s numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tracing {

struct PerfCounter {
  std::string name;  // as it appears in the trace's field name
  std::uint32_t type = 0;
  std::uint64_t config = 0;
};

// "cycles", "L1-dcache-load-misses", "raw:r1C7:NAME". Nothing when there is no such counter.
std::optional<PerfCounter> find_perf_counter(const std::string& name);

}  // namespace tracing
