// SPDX-License-Identifier: Apache-2.0
// Keeps what recording costs within a budget: drops classes of events, one after the other, while they are too many.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tracing/record/account/event_cuts.hpp"
#include "tracing/record/plan/event_classes.hpp"
#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

class OverheadGuard {
 public:
  // The session that `config` describes must record, and its processes count their events (event_counters.hpp). `told`
  // is called from the guard's thread after each cut, and once with an empty class when nothing is left to drop.
  // Throws TraceError when nothing may be dropped from the beginning.
  OverheadGuard(const TraceConfig& config, double ns_per_event, std::function<void(const EventCut&)> told);
  ~OverheadGuard();
  OverheadGuard(const OverheadGuard&) = delete;
  OverheadGuard& operator=(const OverheadGuard&) = delete;

 private:
  void watch();
  void cut(const DroppableClass& drop, std::uint64_t rate);

  TraceConfig config_;
  double ns_per_event_;
  std::function<void(const EventCut&)> told_;
  std::vector<DroppableClass> left_;  // the next one first
  std::mutex mutex_;
  std::condition_variable stopped_;
  bool stop_ = false;
  std::thread thread_;
};

// Whether `rate` events a second cost more than `config` allows.
bool is_over_budget(const TraceConfig& config, double ns_per_event, std::uint64_t rate);

}  // namespace tracing
