// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/execution_tracker.hpp"

namespace tracing {

void ExecutionTracker::start(std::optional<ActiveExecution>& thread, const Served& served, std::int64_t time_ns) {
  ++records_[served].count;
  thread = ActiveExecution{served, time_ns};
}

void ExecutionTracker::end(std::optional<ActiveExecution>& thread, ros2::ExecutionEvent::Kind kind,
                           std::int64_t time_ns) {
  if (!thread || thread->served.kind != kind) {
    return;
  }
  records_[thread->served].durations.add(time_ns - thread->start_ns);
  thread.reset();
}

}  // namespace tracing
