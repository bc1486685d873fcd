// SPDX-License-Identifier: Apache-2.0
// The events of the launcher that tell what happened to the running system.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/model/analysis/results.hpp"

namespace tracing {

class LauncherEventList {
 public:
  // `time` is that of CLOCK_MONOTONIC. Other events than those of the list are left out.
  void add(const Event& event, std::int64_t time);
  // From now on only the last ones, at least so many: for what runs for long.
  void keep_last(std::size_t count) { kept_ = count; }
  // In the order of time. `zero_ns`: the zero of CLOCK_MONOTONIC.
  std::vector<LauncherEventResult> results(std::int64_t zero_ns) const;

 private:
  std::vector<LauncherEventResult> events_;  // on CLOCK_MONOTONIC
  std::optional<std::size_t> kept_;
};

}  // namespace tracing
