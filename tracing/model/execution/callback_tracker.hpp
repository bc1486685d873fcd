// SPDX-License-Identifier: Apache-2.0
// Pairs the starts and ends of callbacks, measures the time between, and tells a sink the instances.
//
// An instance is identified by process, thread and callback: a reentrant callback may run in several threads at once
// with the same address, and callbacks of two processes may have the same address.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/objects/object_model.hpp"
#include "tracing/model/objects/record_at.hpp"

namespace tracing {

// A callback that is running in a thread.
struct ActiveCallback {
  ros2::Handle address = 0;
  ObjectId callback = kNoObject;  // the object that had the address when it started
  std::int64_t start_ns = 0;
  bool intra_process = false;
  // Of the time since then, as events of the kernel's scheduler tell.
  std::int64_t runnable_ns = 0;
  std::int64_t blocked_ns = 0;
};

// The callbacks that run in a thread. The caller keeps them between events.
struct ActiveCallbacks {
  std::vector<ActiveCallback> running;  // innermost last
  bool is_scheduled = false;            // events of the kernel's scheduler tell of the thread
};

struct CallbackRecord {
  DurationStatistics durations;
  std::uint64_t intra_process = 0;
  std::uint64_t unfinished = 0;
};

class CallbackTracker {
 public:
  // The sink must outlive this object.
  explicit CallbackTracker(ExecutionSink& sink) : sink_(sink) {}

  void start(const ThreadId& thread, ActiveCallbacks& active, const ActiveCallback& callback);
  // An end without a start is only counted; it occurs at the begin of a trace.
  // Returns the callback that ended.
  std::optional<ObjectId> end(const ThreadId& thread, ActiveCallbacks& active, ros2::Handle address,
                              std::int64_t time_ns);
  // What the thread did. Tells the sink which callbacks waited for a processor.
  void add(const ThreadInterval& interval, ActiveCallbacks& active);
  // The callbacks still run when the trace ends.
  void abandon(const ThreadId& thread, const ActiveCallbacks& active, std::int64_t time_ns);

  // Indexed by the callback's ObjectId; may be shorter than the model's list.
  const std::vector<CallbackRecord>& records() const { return records_; }
  std::uint64_t ends_without_begin() const { return ends_without_begin_; }

 private:
  CallbackRecord& record(ObjectId callback) { return record_at(records_, callback); }
  void tell_unfinished(const ThreadId& thread, const ActiveCallback& callback, std::int64_t end_ns, bool nested);

  ExecutionSink& sink_;
  std::vector<CallbackRecord> records_;
  std::uint64_t ends_without_begin_ = 0;
};

}  // namespace tracing
