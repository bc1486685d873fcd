// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/callback_tracker.hpp"

#include <algorithm>

namespace tracing {

namespace {

auto find_active(std::vector<ActiveCallback>& thread, ros2::Handle address) {
  return std::find_if(thread.begin(), thread.end(),
                      [address](const ActiveCallback& active) { return active.address == address; });
}

}  // namespace

std::optional<ActiveCallback> CallbackTracker::start(std::vector<ActiveCallback>& thread,
                                                     const ActiveCallback& callback) {
  // An exception has left an earlier instance without an end. A callback that spins, and so runs itself in its own
  // thread, looks the same; its outer instance is lost.
  std::optional<ActiveCallback> lost;
  if (const auto earlier = find_active(thread, callback.address); earlier != thread.end()) {
    ++record(earlier->callback).unfinished;
    lost = *earlier;
    thread.erase(earlier);
  }
  thread.push_back(callback);
  return lost;
}

std::optional<ActiveCallback> CallbackTracker::end(std::vector<ActiveCallback>& thread, ros2::Handle address,
                                                   std::int64_t time_ns) {
  const auto active = find_active(thread, address);
  if (active == thread.end()) {
    return std::nullopt;
  }
  const ActiveCallback instance = *active;
  CallbackRecord& ended = record(instance.callback);
  ended.durations.add(time_ns - instance.start_ns);
  if (instance.intra_process) {
    ++ended.intra_process;
  }
  thread.erase(active);
  return instance;
}

void CallbackTracker::abandon(const std::vector<ActiveCallback>& thread) {
  for (const ActiveCallback& active : thread) {
    ++record(active.callback).unfinished;
  }
}

CallbackRecord& CallbackTracker::record(ObjectId callback) {
  if (callback >= records_.size()) {
    records_.resize(callback + 1);
  }
  return records_[callback];
}

}  // namespace tracing
