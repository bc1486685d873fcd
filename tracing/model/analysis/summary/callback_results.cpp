// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>
#include <utility>

#include "tracing/model/analysis/summary/summary.hpp"
#include "tracing/model/objects/callback_symbol.hpp"
#include "tracing/model/objects/object_names.hpp"

namespace tracing {

namespace {

CallbackResult callback_result(const Subjects& subjects, ObjectId id, const CallbackRecord& record,
                               const CallbackTiming& timings, const HoldUps& hold_ups) {
  const ObjectModel& model = subjects.model();
  const CallbackObject& callback = model.callbacks()[id];
  CallbackResult result;
  result.id = id;
  result.process = subjects.place_of(callback.process);
  result.address = callback.address;
  result.symbol = readable_symbol(callback.symbol);
  result.durations = record.durations.summary();
  result.intra_process = record.intra_process;
  result.unfinished = record.unfinished;

  result.node = node_name(model, callback);
  result.doubtful = subjects.is_doubtful(result.process);
  if (const ObjectId subscription = model.subscription_of(callback); subscription != kNoObject) {
    result.owner = CallbackResult::Owner::kSubscription;
    result.owner_name = model.topics()[model.subscriptions()[subscription].topic].name;
  } else if (callback.owner == CallbackObject::Owner::kTimer && callback.owner_id != kNoObject) {
    result.owner = CallbackResult::Owner::kTimer;
    result.period_ns = model.timers()[callback.owner_id].period_ns;
  } else if (callback.owner == CallbackObject::Owner::kService && callback.owner_id != kNoObject) {
    result.owner = CallbackResult::Owner::kService;
    result.owner_name = model.services()[callback.owner_id].name;
  } else if (callback.owner == CallbackObject::Owner::kClient) {
    result.owner = CallbackResult::Owner::kClient;
    if (callback.owner_id != kNoObject) {
      result.owner_name = model.clients()[callback.owner_id].name;
    }
  }
  const HoldUpRecord::By* const held_up = id < hold_ups.records().size() ? hold_ups.records()[id].most() : nullptr;
  if (held_up != nullptr) {
    const CallbackObject& other = model.callbacks()[held_up->callback];
    const std::string other_node = node_name(model, other);
    result.held_up_by_id = held_up->callback;
    result.held_up_by = (other_node.empty() ? "" : other_node + ", ") + callback_source(model, other);
    result.held_up = held_up->count;
    result.held_up_ns = held_up->ns;
  }
  if (id >= timings.records().size()) {
    return result;
  }
  const CallbackTimingRecord& timing = timings.records()[id];
  result.rate_hz = subjects.rate(timing.begins, timing.first_begin_ns, timing.last_begin_ns);
  result.interval = timing.intervals.summary();
  result.jitter = timing.jitter.summary();
  result.missed = timing.missed;
  result.overruns = timing.overruns;
  if (timings.has_allocations()) {
    result.allocations = timing.allocations;
  }
  result.allocated_bytes = timing.allocated_bytes;
  result.running = timing.running.summary();
  result.runnable = timing.runnable.summary();
  result.blocked = timing.blocked.summary();
  result.longest_runnable_ns = timing.longest_runnable_ns;
  result.ran_instead = timing.ran_instead;
  result.ran_instead_ns = timing.ran_instead_ns;
  return result;
}

}  // namespace

std::vector<CallbackResult> callback_results(const Subjects& subjects, const CallbackTracker& callbacks,
                                             const CallbackTiming& timing, const HoldUps& hold_ups) {
  std::vector<CallbackResult> results;
  for (ObjectId id = 0; id < callbacks.records().size(); ++id) {
    CallbackResult result = callback_result(subjects, id, callbacks.records()[id], timing, hold_ups);
    if (result.durations.count > 0 || result.unfinished > 0) {
      results.push_back(std::move(result));
    }
  }
  std::stable_sort(results.begin(), results.end(), [](const CallbackResult& left, const CallbackResult& right) {
    return std::tie(left.process, left.node, left.owner, left.owner_name, left.period_ns) <
           std::tie(right.process, right.node, right.owner, right.owner_name, right.period_ns);
  });
  return results;
}

}  // namespace tracing
