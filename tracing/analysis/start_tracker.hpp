// SPDX-License-Identifier: Apache-2.0
// How long processes take from their start to a node and to the first wait for work. The events of the launcher and of
// the processes give the times.
//
// A process is "ready" when one of its executors waits or looks for work for the first time: everything that the
// program makes before it spins exists then. ROS 2 has no event for this, and the processes record nothing more for it.
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

  std::vector<std::optional<Kind>> kinds_;  // by EventClass::id, as far as they were needed
  std::vector<Start> starts_;
  std::unordered_map<std::int64_t, Process> processes_;  // by vpid
  // How far zero of CLOCK_MONOTONIC, the field `time` of the launcher's events, is behind the epoch, at most.
  std::optional<std::int64_t> monotonic_zero_ns_;
};

}  // namespace tracing
