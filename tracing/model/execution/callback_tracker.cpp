// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/callback_tracker.hpp"

#include <algorithm>
#include <optional>

namespace tracing {

namespace {

auto find_active(std::vector<ActiveCallback>& active, ros2::Handle address) {
  return std::find_if(active.begin(), active.end(),
                      [address](const ActiveCallback& callback) { return callback.address == address; });
}

}  // namespace

void CallbackTracker::start(const ThreadId& thread, std::vector<ActiveCallback>& active,
                            const ActiveCallback& callback) {
  // An exception has left an earlier instance without an end. A callback that spins, and so runs itself in its own
  // thread, looks the same; its outer instance is lost.
  std::optional<ActiveCallback> lost;
  if (const auto earlier = find_active(active, callback.address); earlier != active.end()) {
    ++record(earlier->callback).unfinished;
    lost = *earlier;
    active.erase(earlier);
  }
  active.push_back(callback);
  const bool nested = active.size() > 1;
  if (lost) {
    tell(thread, *lost, callback.start_ns, nested, false);
  }
  sink_.on_callback_begin({.thread = thread,
                           .callback = callback.callback,
                           .begin_ns = callback.start_ns,
                           .end_ns = callback.start_ns,
                           .intra_process = callback.intra_process,
                           .nested = nested,
                           .finished = false});
}

std::optional<ObjectId> CallbackTracker::end(const ThreadId& thread, std::vector<ActiveCallback>& active,
                                             ros2::Handle address, std::int64_t time_ns) {
  const auto found = find_active(active, address);
  if (found == active.end()) {
    ++ends_without_begin_;
    return std::nullopt;
  }
  const ActiveCallback instance = *found;
  CallbackRecord& ended = record(instance.callback);
  ended.durations.add(time_ns - instance.start_ns);
  if (instance.intra_process) {
    ++ended.intra_process;
  }
  active.erase(found);
  tell(thread, instance, time_ns, !active.empty(), true);
  return instance.callback;
}

void CallbackTracker::abandon(const ThreadId& thread, const std::vector<ActiveCallback>& active, std::int64_t time_ns) {
  for (const ActiveCallback& callback : active) {
    ++record(callback.callback).unfinished;
    tell(thread, callback, time_ns, false, false);
  }
}

CallbackRecord& CallbackTracker::record(ObjectId callback) {
  if (callback >= records_.size()) {
    records_.resize(callback + 1);
  }
  return records_[callback];
}

void CallbackTracker::tell(const ThreadId& thread, const ActiveCallback& callback, std::int64_t end_ns, bool nested,
                           bool finished) {
  sink_.on_callback({.thread = thread,
                     .callback = callback.callback,
                     .begin_ns = callback.start_ns,
                     .end_ns = end_ns,
                     .intra_process = callback.intra_process,
                     .nested = nested,
                     .finished = finished});
}

}  // namespace tracing
