// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/trace_analysis.hpp"

#include <optional>
#include <string_view>
#include <variant>

namespace tracing {

void TraceAnalysis::on_event(const Event& event) {
  const ProcessId process = overview_.count(event);
  if (process == kNoProcess) {
    return;
  }
  if (process >= learned_) [[unlikely]] {
    learn();
  }
  starts_.on_event(event, process);
  const Origin origin{event.timestamp_ns, process, event.vtid.value_or(0)};
  if (decoder_.visit(event, [&](const auto& decoded) {
        release_inits(process);
        ros2_.on_event(origin, decoded);
      })) {
    if (!event.vpid || !event.vtid) [[unlikely]] {
      lacks_thread_context_ = true;
    }
  } else {
    on_other_event(event, origin);
  }
}

void TraceAnalysis::learn() {
  ros2_.learn(overview_.processes());
  learned_ = overview_.processes().processes().size();
}

// Not one of ros2_tracing.
void TraceAnalysis::on_other_event(const Event& event, const Origin& origin) {
  if (of_kernel_.of(*event.event_class, [&] { return event.name().find(':') == std::string_view::npos; })) {
    ros2_.on_kernel_event(event, origin.process);
  } else if (const std::optional<ros2::ObjectEnd> end = ends_.decode(event)) {
    ros2_.on_end(origin, *end);
  } else if (const std::optional<ros2::ExecutionEvent> execution = executions_.decode(event)) {
    ros2_.on_execution(origin, *execution);
  } else if (const std::optional<ros2::LifecycleState> state = lifecycle_states_.decode(event)) {
    ros2_.on_lifecycle_state(origin, state->state_machine, ros2::LifecycleState::label(event));
  } else if (const std::optional<ros2::EndpointQosEvent> endpoint = endpoint_qos_.decode(event)) {
    ros2_.on_endpoint_qos(origin, *endpoint, ros2::EndpointQosEvent::qos(event));
  } else if (const std::optional<std::uint64_t> bytes = allocations_.decode(event)) {
    ros2_.on_allocation(origin, *bytes);
  } else if (const std::optional<std::int64_t> timestamp = writes_.decode(event)) {
    ros2_.on_write(origin, *timestamp);
  } else if (const ros2::CaretDecoder::Decoded* caret = caret_.decode(event)) {
    on_caret_event(origin, *caret);
  }
}

void TraceAnalysis::on_caret_event(const Origin& origin, const ros2::CaretDecoder::Decoded& decoded) {
  if (decoded.init_ns) {
    inits_.keep(origin, *decoded.init_ns, decoded.event);
    return;
  }
  release_inits(origin.process);
  tell(origin, decoded.event);
}

void TraceAnalysis::tell(const Origin& origin, const ros2::KnownCaretEvent& event) {
  if (const auto* const caret = std::get_if<ros2::CaretEvent>(&event)) {
    ros2_.on_caret_event(origin, *caret);
  } else {
    ros2_.on_event(origin, std::get<ros2::AnyEvent>(event));
  }
}

void TraceAnalysis::on_loss(const Loss& loss) {
  overview_.on_loss(loss);
}

TraceResults TraceAnalysis::finish() {
  inits_.release_all([&](const InitsInOrder::Kept& kept) { tell(kept.origin, kept.event); });
  TraceResults results;
  results.overview = overview_.overview();
  const std::vector<std::optional<ProcessIndex>> places = overview_.places();
  for (const auto& [process, time_ns] : starts_.ends(overview_.processes())) {
    ros2_.on_process_end(process, time_ns);
  }
  results.ros2 = ros2_.finish(places, results.overview.processes);
  starts_.finish(overview_.processes(), places, ros2_.first_activity(), results);
  results.ros2.lacks_thread_context = lacks_thread_context_;
  results.warnings = warnings_;
  return results;
}

}  // namespace tracing
