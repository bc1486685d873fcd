// SPDX-License-Identifier: Apache-2.0
// Counts how often executors serve services, clients and waitables, and measures how long services and clients take.
//
// An executor records what it serves next, but not the end of it. A service ends when it sends its response in the same
// thread, and a client when its callback ends. A waitable has no such event, so it is only counted.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "tracing/decode/reader/ext_events.hpp"
#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

// The object that is served. A waitable is known by its address alone: two that have the same address one after the
// other count as one.
struct Served {
  ProcessId process = kNoProcess;
  ros2::ExecutionEvent::Kind kind = ros2::ExecutionEvent::Kind::kService;
  ObjectId id = kNoObject;   // of a service or a client; kNoObject when its initialisation is not in the trace
  ros2::Handle address = 0;  // of a waitable, and of an object without an id

  // NOLINTNEXTLINE(modernize-use-nullptr): takes the 0 of the comparison for a null pointer
  auto operator<=>(const Served&) const = default;
};

// The object that a thread is serving.
struct ActiveExecution {
  Served served;
  std::int64_t start_ns = 0;
};

struct ExecutionRecord {
  std::uint64_t count = 0;
  DurationStatistics durations;  // of the executions whose end is known
};

class ExecutionTracker {
 public:
  // The model must outlive this object.
  explicit ExecutionTracker(const ObjectModel& model) : model_(model) {}

  // An executor serves the object of the event next. The caller keeps `thread` between events.
  void start(std::optional<ActiveExecution>& thread, const Origin& origin, const ros2::ExecutionEvent& event);
  // Ends an execution of this kind; ignored when the thread has none.
  void end(std::optional<ActiveExecution>& thread, ros2::ExecutionEvent::Kind kind, std::int64_t time_ns);

  const std::map<Served, ExecutionRecord>& records() const { return records_; }

 private:
  const ObjectModel& model_;
  std::map<Served, ExecutionRecord> records_;
};

}  // namespace tracing
