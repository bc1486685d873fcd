// SPDX-License-Identifier: Apache-2.0
// Values in the facts of the page.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "tracing/model/analysis/results.hpp"
#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/timeline/timeline.hpp"

namespace tracing {

using PageJson = nlohmann::ordered_json;

inline PageJson optional_json(const std::optional<std::int64_t>& value) {
  return value ? PageJson(*value) : PageJson(nullptr);
}

// Null if nothing was measured.
inline PageJson durations_json(const DurationSummary& summary) {
  if (summary.count == 0) {
    return nullptr;
  }
  return {{"count", summary.count},
          {"mean", summary.mean_ns},
          {"p50", summary.p50_ns},
          {"p99", summary.p99_ns},
          {"max", summary.max_ns}};
}

// The process at a place in the overview; null if there is none.
inline PageJson process_json(const timeline::Timeline& timeline, const std::optional<ProcessIndex>& place) {
  if (!place) {
    return nullptr;
  }
  for (std::size_t id = 0; id < timeline.processes.size(); ++id) {
    if (timeline.processes[id].place == place) {
      return id;
    }
  }
  return nullptr;
}

}  // namespace tracing
