// SPDX-License-Identifier: Apache-2.0
// Pairs the starts and ends of callbacks and measures the time between.
//
// An instance is identified by process, thread and callback: a reentrant callback may run in several threads at once
// with the same address, and callbacks of two processes may have the same address.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/objects/object_model.hpp"

namespace tracing {

// A callback that is running in a thread.
struct ActiveCallback {
  ros2::Handle address = 0;
  ObjectId callback = kNoObject;  // the object that had the address when it started
  std::int64_t start_ns = 0;
  bool intra_process = false;
};

struct CallbackRecord {
  DurationStatistics durations;
  std::uint64_t intra_process = 0;
  std::uint64_t unfinished = 0;
};

class CallbackTracker {
 public:
  // `thread`: the callbacks that run in the event's thread, innermost last. The caller keeps it between events. The
  // result is an earlier instance that will have no end.
  std::optional<ActiveCallback> start(std::vector<ActiveCallback>& thread, const ActiveCallback& callback);
  // The instance that ended. An end without a start is ignored; it occurs at the begin of a trace.
  std::optional<ActiveCallback> end(std::vector<ActiveCallback>& thread, ros2::Handle address, std::int64_t time_ns);
  // Counts the callbacks that still run in a thread when the trace ends.
  void abandon(const std::vector<ActiveCallback>& thread);

  // Indexed by the callback's ObjectId; may be shorter than the model's list.
  const std::vector<CallbackRecord>& records() const { return records_; }

 private:
  CallbackRecord& record(ObjectId callback);

  std::vector<CallbackRecord> records_;
};

}  // namespace tracing
