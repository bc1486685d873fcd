// SPDX-License-Identifier: Apache-2.0
// Calls that are made later, on one thread of the process, which begins with the first of them. Faults that delay
// messages use it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>

#include "rcutils/joined_thread.hpp"

namespace rmw_fastrtps {

class DelayedCalls {
 public:
  using Clock = std::chrono::steady_clock;

  DelayedCalls() = default;
  ~DelayedCalls() { stop(); }
  DelayedCalls(const DelayedCalls&) = delete;
  DelayedCalls& operator=(const DelayedCalls&) = delete;

  // Calls for the same time are made in the order in which they were added.
  void add(const void* owner, Clock::time_point due, std::function<void()> call);
  // After this, no call of the owner runs or will run. Not to be called by a call.
  void forget(const void* owner);
  // What has not been called never is.
  void stop();

 private:
  struct Call {
    const void* owner;
    std::function<void()> function;
  };

  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<Clock::time_point, Call> calls_;
  const void* running_ = nullptr;  // the owner of the call that runs
  bool is_over_ = false;
  rcutils::JoinedThread thread_;
};

// Those of this process. They stop when it exits.
DelayedCalls& delayed_calls();

}  // namespace rmw_fastrtps
