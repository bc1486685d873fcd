// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/execution_tracker.hpp"

namespace tracing {

void ExecutionTracker::start(std::optional<ActiveExecution>& thread, const Origin& origin,
                             const ros2::ExecutionEvent& event) {
  Served served{origin.process, event.kind, kNoObject, 0};
  if (event.kind == ros2::ExecutionEvent::Kind::kService) {
    served.id = model_.service(origin.process, event.handle);
  } else if (event.kind == ros2::ExecutionEvent::Kind::kClient) {
    served.id = model_.client(origin.process, event.handle);
  }
  if (served.id == kNoObject) {
    served.address = event.handle;
  }
  ++records_[served].count;
  thread = ActiveExecution{served, origin.time_ns};
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
