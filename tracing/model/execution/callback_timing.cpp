// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/callback_timing.hpp"

#include <algorithm>
#include <cstdlib>

namespace tracing {

std::int64_t CallbackTiming::period_of(ObjectId id) const {
  const CallbackObject& callback = model_.callbacks()[id];
  const bool is_of_timer = callback.owner == CallbackObject::Owner::kTimer && callback.owner_id != kNoObject;
  return is_of_timer ? model_.timers()[callback.owner_id].period_ns : 0;
}

void CallbackTiming::on_callback_begin(const CallbackInstance& instance) {
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
  if (instance.is_scheduled) {
    CallbackTimingRecord& timing = record(instance.callback);
    timing.running.add(instance.end_ns - instance.begin_ns - instance.runnable_ns - instance.blocked_ns);
    timing.runnable.add(instance.runnable_ns);
    timing.blocked.add(instance.blocked_ns);
  }
}

void CallbackTiming::on_allocation(const Allocation& allocation) {
  has_allocations_ = true;
  if (allocation.callback == kNoObject) {
    return;
  }
  CallbackTimingRecord& timing = record(allocation.callback);
  ++timing.allocations;
  timing.allocated_bytes += allocation.bytes;
}

void CallbackTiming::on_callback_wait(const CallbackWait& wait) {
  CallbackTimingRecord& timing = record(wait.callback);
  if (wait.took_ns > timing.longest_runnable_ns) {
    timing.longest_runnable_ns = wait.took_ns;
    timing.ran_instead = wait.other_name;
    timing.ran_instead_ns = std::min(wait.other_ns, wait.took_ns);
  }
}

}  // namespace tracing
