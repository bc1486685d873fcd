// SPDX-License-Identifier: Apache-2.0
#include "faults/delayed_calls.hpp"

#include <cstdlib>
#include <iterator>
#include <utility>

namespace rmw_fastrtps {

void DelayedCalls::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void DelayedCalls::add(const void* owner, Clock::time_point due, std::function<void()> call) {
  {
    const std::lock_guard lock(mutex_);
    calls_.emplace(due, Call{owner, std::move(call)});
    if (!thread_.joinable() && !is_over_) {
      thread_ = rcutils::JoinedThread([this] { run(); });
    }
  }
  changed_.notify_all();
}

void DelayedCalls::forget(const void* owner) {
  std::unique_lock lock(mutex_);
  for (auto call = calls_.begin(); call != calls_.end();) {
    call = call->second.owner == owner ? calls_.erase(call) : std::next(call);
  }
  changed_.wait(lock, [&] { return running_ != owner; });
}

void DelayedCalls::run() {
  std::unique_lock lock(mutex_);
  while (!is_over_) {
    if (calls_.empty()) {
      changed_.wait(lock);
      continue;
    }
    const Clock::time_point due = calls_.begin()->first;
    if (Clock::now() < due) {
      changed_.wait_until(lock, due);
      continue;
    }
    Call call = std::move(calls_.extract(calls_.begin()).mapped());
    running_ = call.owner;
    lock.unlock();
    call.function();
    call.function = nullptr;
    lock.lock();
    running_ = nullptr;
    changed_.notify_all();
  }
}

DelayedCalls& delayed_calls() {
  // Never destroyed: an endpoint may be destroyed later than any static object.
  static DelayedCalls* const calls = [] {
    auto* const made = new DelayedCalls();
    (void)std::atexit([] { delayed_calls().stop(); });
    return made;
  }();
  return *calls;
}

}  // namespace rmw_fastrtps
