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
  threads_[instance.thread].active.push_back({instance.callback, instance.begin_ns, 0, 0});
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
  Thread& thread = threads_[instance.thread];
  const auto innermost = std::find_if(thread.active.rbegin(), thread.active.rend(),
                                      [&](const Active& active) { return active.callback == instance.callback; });
  if (innermost == thread.active.rend()) {
    return;
  }
  if (thread.is_scheduled && instance.finished) {
    CallbackTimingRecord& timing = record(instance.callback);
    timing.running.add(instance.end_ns - instance.begin_ns - innermost->runnable_ns - innermost->blocked_ns);
    timing.runnable.add(innermost->runnable_ns);
    timing.blocked.add(innermost->blocked_ns);
  }
  thread.active.erase(std::next(innermost).base());
}

void CallbackTiming::on_allocation(const Allocation& allocation) {
  has_allocations_ = true;
  const Thread* const thread = threads_.find(allocation.thread);
  if (thread == nullptr || thread->active.empty()) {
    return;
  }
  CallbackTimingRecord& timing = record(thread->active.back().callback);
  ++timing.allocations;
  timing.allocated_bytes += allocation.bytes;
}

// The thread runs whenever a callback begins or ends, so that other intervals lie within callbacks as a whole.
void CallbackTiming::on_thread_state(const ThreadInterval& interval) {
  Thread& thread = threads_[interval.thread];
  thread.is_scheduled = true;
  if (interval.state == ThreadInterval::State::kRunning) {
    return;
  }
  for (Active& active : thread.active) {
    const std::int64_t took = interval.end_ns - std::max(interval.begin_ns, active.begin_ns);
    if (interval.state == ThreadInterval::State::kBlocked) {
      active.blocked_ns += took;
      continue;
    }
    active.runnable_ns += took;
    CallbackTimingRecord& timing = record(active.callback);
    if (took > timing.longest_runnable_ns) {
      timing.longest_runnable_ns = took;
      timing.ran_instead = interval.other_name;
      timing.ran_instead_ns = std::min(interval.other_ns, took);
    }
  }
}

}  // namespace tracing
