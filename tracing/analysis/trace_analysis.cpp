// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/trace_analysis.hpp"

namespace tracing {

void TraceAnalysis::on_event(const Event& event) {
  overview_.on_event(event);
  starts_.on_event(event);
  const Origin origin{event.timestamp_ns, event.vpid.value_or(0), event.vtid.value_or(0)};
  if (const ros2::AnyEvent* decoded = decoder_.decode(event)) {
    if (!event.vpid || !event.vtid) lacks_thread_context_ = true;
    ros2_.on_event(origin, *decoded);
  } else if (const std::optional<ros2::ObjectEnd> end = ends_.decode(event)) {
    ros2_.on_end(origin, *end);
  } else if (const std::optional<ros2::ExecutionEvent> execution = executions_.decode(event)) {
    ros2_.on_execution(origin, *execution);
  }
}

void TraceAnalysis::on_loss(const Loss& loss) {
  overview_.on_loss(loss);
}

TraceResults TraceAnalysis::finish() {
  TraceResults results{overview_.overview(), starts_.finish(), ros2_.finish(), warnings_};
  results.ros2.lacks_thread_context = lacks_thread_context_;
  return results;
}

}  // namespace tracing
