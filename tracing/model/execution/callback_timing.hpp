// SPDX-License-Identifier: Apache-2.0
// How regularly callbacks run, how much time they take of their thread, and how much memory they ask for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/objects/record_at.hpp"

namespace tracing {

struct CallbackTimingRecord {
  std::int64_t first_begin_ns = 0;
  std::int64_t last_begin_ns = 0;
  std::uint64_t begins = 0;
  DurationStatistics intervals;  // from one begin to the next
  DurationStatistics jitter;     // of a timer: how far the intervals are from the period, either way
  std::uint64_t missed = 0;      // of a timer: periods without a call
  std::uint64_t overruns = 0;    // of a timer: runs that took longer than its period
  std::uint64_t allocations = 0;
  std::uint64_t allocated_bytes = 0;

  // Of the instances whose thread is in events of the kernel's scheduler.
  DurationStatistics running;
  DurationStatistics runnable;  // waited for a processor
  DurationStatistics blocked;
  std::int64_t longest_runnable_ns = 0;  // without a break
  std::string ran_instead;               // the thread that had the processor for most of that time
  std::int64_t ran_instead_ns = 0;       // for how long
};

class CallbackTiming : public ExecutionSink {
 public:
  // The model must outlive this object.
  explicit CallbackTiming(const ObjectModel& model) : model_(model) {}

  void on_callback_begin(const CallbackInstance& instance) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_allocation(const Allocation& allocation) override;
  void on_callback_wait(const CallbackWait& wait) override;

  // Indexed by the callback's ObjectId; may be shorter than the model's list.
  const std::vector<CallbackTimingRecord>& records() const { return records_; }
  bool has_allocations() const { return has_allocations_; }

 private:
  CallbackTimingRecord& record(ObjectId callback) { return record_at(records_, callback); }
  // Of a timer; 0 for any other callback.
  std::int64_t period_of(ObjectId callback) const;

  const ObjectModel& model_;
  std::vector<CallbackTimingRecord> records_;
  bool has_allocations_ = false;
};

}  // namespace tracing
