// SPDX-License-Identifier: Apache-2.0
// Counts the changes of the graph. Any number of threads can wait for a change.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace rmw_fastrtps {

class GraphChanges {
 public:
  void add() {
    {
      const std::lock_guard lock(mutex_);
      ++number_;
    }
    changed_.notify_all();
  }

  // Ends all waits, current and later ones.
  void end() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
  }

  // Waits until the number differs from `seen`, which then gets it, or until end(). Returns false when the time is
  // over; a negative timeout never ends.
  bool wait(std::uint64_t& seen, std::chrono::nanoseconds timeout) {
    std::unique_lock lock(mutex_);
    const auto is_over = [&] { return ended_ || number_ != seen; };
    bool over = true;
    if (timeout < std::chrono::nanoseconds::zero()) {
      changed_.wait(lock, is_over);
    } else {
      over = changed_.wait_for(lock, timeout, is_over);
    }
    seen = number_;
    return over;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t number_ = 0;
  bool ended_ = false;
};

}  // namespace rmw_fastrtps
