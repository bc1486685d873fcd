// SPDX-License-Identifier: Apache-2.0
// Which executor runs which callbacks, from the events of CARET. ROS 2's own events do not tell.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tracing/decode/reader/caret_events.hpp"
#include "tracing/model/objects/handle_index.hpp"
#include "tracing/model/objects/object_model.hpp"
#include "tracing/model/objects/objects.hpp"

namespace tracing {

struct ExecutorObject {
  ProcessId process = kNoProcess;
  ros2::Handle address = 0;
  std::string kind;  // single_threaded_executor, multi_threaded_executor, static_single_threaded_executor; or empty
};

struct GroupObject {
  ProcessId process = kNoProcess;
  ros2::Handle address = 0;
  ObjectId executor = kNoObject;
  std::string kind;  // mutually_exclusive, reentrant; or empty
};

struct SimulatedTime {
  ProcessId process = kNoProcess;
  std::int64_t time_ns = 0;
  std::int64_t simulated_ns = 0;
};

class CallbackGroups {
 public:
  // `model` has had the events before, and must outlive this object.
  explicit CallbackGroups(const ObjectModel& model) : model_(model) {}
  void on(const Origin& origin, const ros2::CaretEvent& event);

  const std::vector<ExecutorObject>& executors() const { return executors_; }
  const std::vector<GroupObject>& groups() const { return groups_; }
  const std::vector<SimulatedTime>& simulated_times() const { return simulated_times_; }
  // kNoObject: the trace does not tell.
  ObjectId group_of(const CallbackObject& callback) const;

 private:
  using Owner = CallbackObject::Owner;

  ObjectId executor(ProcessId process, ros2::Handle address);
  ObjectId group(ProcessId process, ros2::Handle address);
  void add_member(const Origin& origin, const ros2::CaretEvent& event, Owner owner, ObjectId id);

  const ObjectModel& model_;
  std::vector<ExecutorObject> executors_;
  std::vector<GroupObject> groups_;
  std::vector<SimulatedTime> simulated_times_;
  HandleIndex<ObjectId> executor_index_;
  HandleIndex<ObjectId> group_index_;
  HandleIndex<ObjectId> executor_of_collector_;
  HandleIndex<std::vector<ObjectId>> waiting_groups_;  // of a collector whose executor is not known yet
  std::map<std::pair<Owner, ObjectId>, ObjectId> group_of_;
};

}  // namespace tracing
