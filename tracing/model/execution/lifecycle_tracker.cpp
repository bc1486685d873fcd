// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/lifecycle_tracker.hpp"

namespace tracing {

void LifecycleTracker::enter(LifecycleRecord& current, ProcessId process, ObjectId node, std::string_view state,
                             std::int64_t time_ns) {
  current = {
      node,   std::string(state), time_ns, 0, false, allocations_.of_node(node), allocations_.of_process(process),
      process};
}

void LifecycleTracker::leave(LifecycleRecord& current, ProcessId process, std::int64_t time_ns, bool ended) {
  current.end_ns = time_ns;
  current.ended = ended;
  current.of_callbacks = allocations_.of_node(current.node) - current.of_callbacks;
  current.of_process = allocations_.of_process(process) - current.of_process;
  sink_.on_lifecycle_state({current.node, current.state, current.begin_ns, current.end_ns, current.ended});
  records_.push_back(current);
}

void LifecycleTracker::on(const Origin& origin, const ros2::RclLifecycleStateMachineInit& event) {
  const ObjectId node = model_.node(origin.process, event.node_handle);
  const auto [found, is_new] = current_.try_emplace({origin.process, event.state_machine});
  LifecycleRecord& current = found->second;
  if (!is_new) {
    if (current.node == node || current.node == kNoObject) {
      current.node = node;
      return;
    }
    leave(current, origin.process, origin.time_ns, true);  // a new state machine at the address of an older one
  }
  enter(current, origin.process, node, "unconfigured", origin.time_ns);
}

void LifecycleTracker::on(const Origin& origin, const ros2::RclLifecycleTransition& event) {
  const auto [found, is_new] = current_.try_emplace({origin.process, event.state_machine});
  LifecycleRecord& current = found->second;
  // An event between was lost when the node was not in the state that it leaves.
  if (!is_new && current.state == event.start_label) {
    leave(current, origin.process, origin.time_ns, true);
  }
  enter(current, origin.process, current.node, event.goal_label, origin.time_ns);
}

void LifecycleTracker::state(const Origin& origin, ros2::Handle state_machine, std::string_view state) {
  const auto [found, is_new] = current_.try_emplace({origin.process, state_machine});
  LifecycleRecord& current = found->second;
  if (!is_new && current.state == state) {
    return;
  }
  // The state dump announces the state machine just before: nothing is known about the time since it began.
  const bool just_announced = !is_new && current.state == "unconfigured";
  if (!is_new && !just_announced) {
    leave(current, origin.process, origin.time_ns, true);
  }
  enter(current, origin.process, current.node, state, origin.time_ns);
}

void LifecycleTracker::end(const Origin& origin, ros2::Handle state_machine) {
  const auto found = current_.find({origin.process, state_machine});
  if (found == current_.end()) {
    return;
  }
  leave(found->second, origin.process, origin.time_ns, true);
  current_.erase(found);
}

void LifecycleTracker::finish(std::int64_t end_ns) {
  for (auto& [key, current] : current_) {
    leave(current, key.first, end_ns, false);
  }
  current_.clear();
}

}  // namespace tracing
