// SPDX-License-Identifier: Apache-2.0
#include "executor/sleeping_threads.hpp"

#include <cstdint>

namespace rclcpp {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

void SleepingThreads::sleep(std::unique_lock<std::mutex>& lock, steady_clock::time_point deadline, TimerQueue& timers) {
  if (unused_.empty()) {
    unused_.push_back(&threads_.emplace_back());
  }
  Thread& thread = *unused_.back();
  unused_.pop_back();
  thread.is_woken = false;
  asleep_.push_back(&thread);
  if (for_timers_ == nullptr) {
    lacks_one_for_timers_ = false;
    if (const std::int64_t until = timers.time_until_first(); until != TimerQueue::kNever) {
      for_timers_ = &thread;
      const auto now = steady_clock::now();
      if (nanoseconds(until) < deadline - now) {
        deadline = now + nanoseconds(until);
      }
    }
  }
  const auto is_woken = [&thread] { return thread.is_woken; };
  if (deadline == steady_clock::time_point::max()) {
    thread.wakes.wait(lock, is_woken);
  } else {
    thread.wakes.wait_until(lock, deadline, is_woken);
  }
  if (thread.is_woken) {
    --count_woken_;
  } else {
    std::erase(asleep_, &thread);
  }
  if (for_timers_ == &thread) {
    for_timers_ = nullptr;
    lacks_one_for_timers_ = true;
  }
  unused_.push_back(&thread);
}

SleepingThreads::Thread* SleepingThreads::wake_one() {
  if (asleep_.empty()) {
    return nullptr;
  }
  return wake(asleep_.size() > 1 && asleep_.back() == for_timers_ ? asleep_[asleep_.size() - 2] : asleep_.back());
}

SleepingThreads::Thread* SleepingThreads::wake_for_timers() {
  return for_timers_ != nullptr && !for_timers_->is_woken ? wake(for_timers_) : wake_one();
}

SleepingThreads::Thread* SleepingThreads::wake(Thread* thread) {
  std::erase(asleep_, thread);
  thread->is_woken = true;
  ++count_woken_;
  return thread;
}

}  // namespace rclcpp
