// SPDX-License-Identifier: Apache-2.0
// How long processes take from their start to a node and to the first wait for work, from the launcher's events and
// theirs.
//
// "Ready" is when an executor of the process waits or looks for work the first time: what the program makes before it
// spins is there then. ROS 2 has no event for it; nothing is asked of the processes but what they record anyway.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracing/analysis/results.hpp"
#include "tracing/reader/event.hpp"

namespace tracing {

class StartTracker {
 public:
  void on_event(const Event& event);
  // In the order of the launcher's events.
  std::vector<StartResult> finish() const;

 private:
  enum class Kind : std::uint8_t { kOther, kExec, kLaunch, kNode, kExecutor };
  struct Process {
    std::optional<std::int64_t> node_ns;
    std::optional<std::int64_t> executor_ns;
    bool late = false;  // the trace began after the process
  };
  struct Start {
    StartResult result;
    std::int64_t monotonic_ns = 0;
  };

  Kind kind_of(const Event& event);

  std::vector<std::optional<Kind>> kinds_;  // by EventClass::id, as far as asked for
  std::vector<Start> starts_;
  std::unordered_map<std::int64_t, Process> processes_;  // by vpid
  // Of the launcher's events, whose field `time` is CLOCK_MONOTONIC: how far its zero is behind the epoch, at most.
  std::optional<std::int64_t> monotonic_zero_ns_;
};

}  // namespace tracing
