// SPDX-License-Identifier: Apache-2.0
// The events of the launcher that tell what happened to the running system.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/model/analysis/results.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

class LauncherEventList {
 public:
  // `time` is that of the launcher's CLOCK_MONOTONIC. Other events than those of the list are left out.
  void add(const Event& event, std::int64_t time, ProcessId launcher);
  // From now on only the last ones, at least so many: for what runs for long.
  void keep_last(std::size_t count) { kept_ = count; }
  // In the order of time.
  std::vector<LauncherEventResult> results() const;

 private:
  struct Told {
    ProcessId launcher = kNoProcess;
    LauncherEventResult event;  // on CLOCK_MONOTONIC
  };
  std::vector<Told> events_;
  std::map<ProcessId, std::int64_t> zeros_ns_;  // of CLOCK_MONOTONIC of each launcher's machine, at most
  std::optional<std::size_t> kept_;
};

}  // namespace tracing
