// SPDX-License-Identifier: Apache-2.0
#include "tracing/analysis/callback_tracker.hpp"

#include <algorithm>

namespace tracing {

namespace {

auto find_active(std::vector<ActiveCallback>& thread, ros2::Handle address) {
  return std::find_if(thread.begin(), thread.end(),
                      [address](const ActiveCallback& active) { return active.address == address; });
}

}  // namespace

void CallbackTracker::start(std::vector<ActiveCallback>& thread, const ActiveCallback& callback) {
  // An exception has left an earlier instance without an end. A callback that spins, and so runs itself in its own
  // thread, looks the same; its outer instance is lost.
  const auto earlier = find_active(thread, callback.address);
  if (earlier != thread.end()) {
    ++record(earlier->callback).unfinished;
    thread.erase(earlier);
  }
  thread.push_back(callback);
}

void CallbackTracker::end(std::vector<ActiveCallback>& thread, ros2::Handle address, std::int64_t time_ns) {
  const auto active = find_active(thread, address);
  if (active == thread.end()) return;
  CallbackRecord& ended = record(active->callback);
  ended.durations.add(time_ns - active->start_ns);
  if (active->intra_process) ++ended.intra_process;
  thread.erase(active);
}

void CallbackTracker::abandon(const std::vector<ActiveCallback>& thread) {
  for (const ActiveCallback& active : thread) ++record(active.callback).unfinished;
}

CallbackRecord& CallbackTracker::record(ObjectId callback) {
  if (callback >= records_.size()) records_.resize(callback + 1);
  return records_[callback];
}

}  // namespace tracing
