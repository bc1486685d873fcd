// SPDX-License-Identifier: Apache-2.0
// Events in the order of their arrival, without a limit.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>

#include "rclcpp/experimental/executors/events_executor/events_queue.hpp"

namespace rclcpp::experimental::executors {

class SimpleEventsQueue : public EventsQueue {
 public:
  void enqueue(const ExecutorEvent& event) override {
    {
      const std::lock_guard lock(mutex_);
      ExecutorEvent single = event;
      single.num_events = 1;
      events_.insert(events_.end(), event.num_events, single);
    }
    arrived_.notify_one();
  }

  bool dequeue(ExecutorEvent& event, std::chrono::nanoseconds timeout = std::chrono::nanoseconds::max()) override {
    std::unique_lock lock(mutex_);
    const auto has_event = [this] { return !events_.empty(); };
    if (timeout == std::chrono::nanoseconds::max()) {
      arrived_.wait(lock, has_event);
    } else if (timeout > std::chrono::nanoseconds::zero()) {  // a wait for no time would still ask the kernel
      arrived_.wait_until(lock, std::chrono::steady_clock::now() + timeout, has_event);
    }
    if (events_.empty()) {
      return false;
    }
    event = events_.front();
    events_.pop_front();
    return true;
  }

  bool empty() const override {
    const std::lock_guard lock(mutex_);
    return events_.empty();
  }

  size_t size() const override {
    const std::lock_guard lock(mutex_);
    return events_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<ExecutorEvent> events_;
};

}  // namespace rclcpp::experimental::executors
