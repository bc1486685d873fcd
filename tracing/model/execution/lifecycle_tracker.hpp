// SPDX-License-Identifier: Apache-2.0
// How long lifecycle nodes are in their states.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tracing/model/execution/allocation_counter.hpp"
#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

// One stay in a state. While it lasts, the counts are those at its begin.
struct LifecycleRecord {
  ObjectId node = kNoObject;
  std::string state;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  bool ended = true;
  AllocationCount of_callbacks = {};  // of the node, in this state
  AllocationCount of_process = {};
  ProcessId process = kNoProcess;
};

class LifecycleTracker {
 public:
  // Tells the sink each stay in a state. All must outlive this object.
  LifecycleTracker(const ObjectModel& model, const AllocationCounter& allocations, ExecutionSink& sink)
      : model_(model), allocations_(allocations), sink_(sink) {}

  // A new state machine is unconfigured; ROS 2 records no event for that. The state dump of a living one is ignored.
  void on(const Origin& origin, const ros2::RclLifecycleStateMachineInit& event);
  void on(const Origin& origin, const ros2::RclLifecycleTransition& event);
  // The current state, from a state dump. The time before is unknown.
  void state(const Origin& origin, ros2::Handle state_machine, std::string_view state);
  // The object at the address ends; the node stays in the list of intervals.
  void end(const Origin& origin, ros2::Handle state_machine);
  void finish(std::int64_t end_ns);

  const std::vector<LifecycleRecord>& records() const { return records_; }  // in the order of their ends

 private:
  using Key = std::pair<ProcessId, ros2::Handle>;
  void enter(LifecycleRecord& current, ProcessId process, ObjectId node, std::string_view state, std::int64_t time_ns);
  void leave(LifecycleRecord& current, ProcessId process, std::int64_t time_ns, bool ended);

  const ObjectModel& model_;
  const AllocationCounter& allocations_;
  ExecutionSink& sink_;
  std::map<Key, LifecycleRecord> current_;
  std::vector<LifecycleRecord> records_;
};

}  // namespace tracing
