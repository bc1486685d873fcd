// SPDX-License-Identifier: Apache-2.0
// Counts the changes of the graph, for any number of threads that wait for one.
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

  // Nobody waits any more, now or later.
  void end() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
  }

  // Until the number is another than `seen`, which gets it, or end(). False when the time is over; a negative one never
  // is.
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
