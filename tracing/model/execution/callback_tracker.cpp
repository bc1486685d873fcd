// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/callback_tracker.hpp"

#include <algorithm>
#include <optional>

namespace tracing {

namespace {

auto find_active(std::vector<ActiveCallback>& running, ros2::Handle address) {
  return std::find_if(running.begin(), running.end(),
                      [address](const ActiveCallback& callback) { return callback.address == address; });
}

}  // namespace

void CallbackTracker::start(const ThreadId& thread, ActiveCallbacks& active, const ActiveCallback& callback) {
  std::vector<ActiveCallback>& running = active.running;
  // An exception has left an earlier instance without an end. A callback that spins, and so runs itself in its own
  // thread, looks the same; its outer instance is lost.
  std::optional<ActiveCallback> lost;
  if (const auto earlier = find_active(running, callback.address); earlier != running.end()) {
    ++record(earlier->callback).unfinished;
    lost = *earlier;
    running.erase(earlier);
  }
  running.push_back(callback);
  const bool nested = running.size() > 1;
  if (lost) {
    tell_unfinished(thread, *lost, callback.start_ns, nested);
  }
  sink_.on_callback_begin({.thread = thread,
                           .callback = callback.callback,
                           .begin_ns = callback.start_ns,
                           .end_ns = callback.start_ns,
                           .intra_process = callback.intra_process,
                           .nested = nested,
                           .finished = false});
}

std::optional<ObjectId> CallbackTracker::end(const ThreadId& thread, ActiveCallbacks& active, ros2::Handle address,
                                             std::int64_t time_ns) {
  std::vector<ActiveCallback>& running = active.running;
  const auto found = find_active(running, address);
  if (found == running.end()) {
    ++ends_without_begin_;
    return std::nullopt;
  }
  const ActiveCallback instance = *found;
  CallbackRecord& ended = record(instance.callback);
  ended.durations.add(time_ns - instance.start_ns);
  if (instance.intra_process) {
    ++ended.intra_process;
  }
  running.erase(found);
  sink_.on_callback({.thread = thread,
                     .callback = instance.callback,
                     .begin_ns = instance.start_ns,
                     .end_ns = time_ns,
                     .intra_process = instance.intra_process,
                     .nested = !running.empty(),
                     .finished = true,
                     .is_scheduled = active.is_scheduled,
                     .runnable_ns = instance.runnable_ns,
                     .blocked_ns = instance.blocked_ns});
  return instance.callback;
}

// The thread runs whenever a callback begins or ends, so that other intervals lie within callbacks as a whole.
void CallbackTracker::add(const ThreadInterval& interval, ActiveCallbacks& active) {
  active.is_scheduled = true;
  if (interval.state == ThreadInterval::State::kRunning) {
    return;
  }
  for (ActiveCallback& callback : active.running) {
    const std::int64_t took = interval.end_ns - std::max(interval.begin_ns, callback.start_ns);
    if (interval.state == ThreadInterval::State::kBlocked) {
      callback.blocked_ns += took;
      continue;
    }
    callback.runnable_ns += took;
    sink_.on_callback_wait({callback.callback, took, interval.other_name, interval.other_ns});
  }
}

void CallbackTracker::abandon(const ThreadId& thread, const ActiveCallbacks& active, std::int64_t time_ns) {
  for (const ActiveCallback& callback : active.running) {
    ++record(callback.callback).unfinished;
    tell_unfinished(thread, callback, time_ns, false);
  }
}

void CallbackTracker::tell_unfinished(const ThreadId& thread, const ActiveCallback& callback, std::int64_t end_ns,
                                      bool nested) {
  sink_.on_callback({.thread = thread,
                     .callback = callback.callback,
                     .begin_ns = callback.start_ns,
                     .end_ns = end_ns,
                     .intra_process = callback.intra_process,
                     .nested = nested,
                     .finished = false});
}

}  // namespace tracing
