// SPDX-License-Identifier: Apache-2.0
// Everything that a page or an export is made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/timeline/other_process.hpp"
#include "tracing/model/timeline/recorded_verdict.hpp"
#include "tracing/model/timeline/timeline.hpp"

namespace tracing {

struct TracedSystem {
  std::filesystem::path directory;  // of the trace, absolute
  timeline::Timeline timeline;
  std::int64_t first_event_ns = 0;  // the launcher's events count; 0: there is none
  TraceResults results;
  std::string error;                        // why reading stopped early; empty when all was read
  std::vector<std::filesystem::path> open;  // traces that were still being written
  RecordedVerdict verdict = {};
  std::vector<OtherProcess> others = {};  // whose events were left out
};

}  // namespace tracing
