// SPDX-License-Identifier: Apache-2.0
// The threads of an executor that have nothing to do. The last one that fell asleep is woken first, because its memory
// is still in the caches. One of them wakes for the next timer.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <vector>

#include "executor/timer_queue.hpp"

namespace rclcpp {

// The owner's mutex is held during all calls but notify().
class SleepingThreads {
 public:
  struct Thread {
    std::condition_variable wakes;
    bool is_woken = false;
  };

  // Sleeps until this thread is woken, until `deadline`, or until a timer is due and no other thread wakes for it.
  void sleep(std::unique_lock<std::mutex>& lock, std::chrono::steady_clock::time_point deadline, TimerQueue& timers);

  // Takes a thread out of those that sleep. Null if none sleeps.
  Thread* wake_one();
  // The one that wakes for timers, else any.
  Thread* wake_for_timers();
  // Call it with the result when the mutex is released. Null is allowed.
  static void notify(Thread* thread) {
    if (thread != nullptr) {
      thread->wakes.notify_one();
    }
  }

  // Whether fewer threads are awake and about to look than there is work, or no thread wakes for timers any more.
  bool is_one_needed(std::size_t work) const {
    return work > count_woken_ || (lacks_one_for_timers_ && count_woken_ == 0);
  }

 private:
  Thread* wake(Thread* thread);

  std::deque<Thread> threads_;  // they live as long as this: a thread is notified without the mutex
  std::vector<Thread*> unused_;
  std::vector<Thread*> asleep_;   // the last one is woken first
  Thread* for_timers_ = nullptr;  // of those asleep
  bool lacks_one_for_timers_ = false;
  std::size_t count_woken_ = 0;  // which have not looked yet
};

}  // namespace rclcpp
