// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/callback_timing.hpp"

#include <algorithm>
#include <cstdlib>

namespace tracing {

CallbackTimingRecord& CallbackTiming::record(ObjectId callback) {
  if (callback >= records_.size()) {
    records_.resize(callback + 1);
  }
  return records_[callback];
}

std::int64_t CallbackTiming::period_of(ObjectId id) const {
  const CallbackObject& callback = model_.callbacks()[id];
  const bool is_of_timer = callback.owner == CallbackObject::Owner::kTimer && callback.owner_id != kNoObject;
  return is_of_timer ? model_.timers()[callback.owner_id].period_ns : 0;
}

void CallbackTiming::on_callback_begin(const CallbackInstance& instance) {
  active_.begin(instance);
  CallbackTimingRecord& timing = record(instance.callback);
  if (timing.begins++ == 0) {
    timing.first_begin_ns = timing.last_begin_ns = instance.begin_ns;
    return;
  }
  const std::int64_t interval = instance.begin_ns - timing.last_begin_ns;
  timing.last_begin_ns = instance.begin_ns;
  timing.intervals.add(interval);
  const std::int64_t period = period_of(instance.callback);
  if (period <= 0) {
    return;
  }
  timing.jitter.add(std::abs(interval - period));
  // An interval of one and a half periods still is one late call.
  if (interval > period + period / 2) {
    timing.missed += static_cast<std::uint64_t>((interval + period / 2) / period - 1);
  }
}

void CallbackTiming::on_callback(const CallbackInstance& instance) {
  if (const std::int64_t period = period_of(instance.callback);
      period > 0 && instance.finished && instance.end_ns - instance.begin_ns > period) {
    ++record(instance.callback).overruns;
  }
  if (const auto parts = active_.end(instance)) {
    CallbackTimingRecord& timing = record(instance.callback);
    timing.running.add(parts->running_ns);
    timing.runnable.add(parts->runnable_ns);
    timing.blocked.add(parts->blocked_ns);
  }
}

void CallbackTiming::on_allocation(const Allocation& allocation) {
  has_allocations_ = true;
  const ObjectId callback = active_.innermost(allocation.thread);
  if (callback == kNoObject) {
    return;
  }
  CallbackTimingRecord& timing = record(callback);
  ++timing.allocations;
  timing.allocated_bytes += allocation.bytes;
}

void CallbackTiming::on_thread_state(const ThreadInterval& interval) {
  active_.add(interval, [&](ObjectId callback, std::int64_t took) {
    CallbackTimingRecord& timing = record(callback);
    if (took > timing.longest_runnable_ns) {
      timing.longest_runnable_ns = took;
      timing.ran_instead = interval.other_name;
      timing.ran_instead_ns = std::min(interval.other_ns, took);
    }
  });
}

}  // namespace tracing
