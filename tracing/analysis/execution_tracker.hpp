// SPDX-License-Identifier: Apache-2.0
// Counts what executors serve of services, clients and waitables, and measures how long services and clients take.
//
// An executor tells what it serves next, and not that it is done. A service is done when it has sent its response, in
// the same thread, a client when its callback has ended; a waitable has no such event, so that it is counted only.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "tracing/analysis/duration_statistics.hpp"
#include "tracing/analysis/object_model.hpp"
#include "tracing/reader/execution_event.hpp"

namespace tracing {

// Who is served. A waitable is known by its address alone: two that had the same one after another count as one.
struct Served {
  Vpid vpid = 0;
  ros2::ExecutionEvent::Kind kind = ros2::ExecutionEvent::Kind::kService;
  ObjectId id = kNoObject;   // of a service or a client; kNoObject when its initialisation is not in the trace
  ros2::Handle address = 0;  // of a waitable, and of what has no id

  auto operator<=>(const Served&) const = default;
};

// What a thread is serving.
struct ActiveExecution {
  Served served;
  std::int64_t start_ns = 0;
};

struct ExecutionRecord {
  std::uint64_t count = 0;
  DurationStatistics durations;  // of those whose end is known
};

class ExecutionTracker {
 public:
  // `thread`: kept by the caller between events.
  void start(std::optional<ActiveExecution>& thread, const Served& served, std::int64_t time_ns);
  // Of an execution of this kind; ignored when the thread has none.
  void end(std::optional<ActiveExecution>& thread, ros2::ExecutionEvent::Kind kind, std::int64_t time_ns);

  const std::map<Served, ExecutionRecord>& records() const { return records_; }

 private:
  std::map<Served, ExecutionRecord> records_;
};

}  // namespace tracing
