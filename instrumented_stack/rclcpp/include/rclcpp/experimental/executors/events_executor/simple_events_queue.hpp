// SPDX-License-Identifier: Apache-2.0
// Events in turns, without a limit: an entity with several events takes one, then each other entity that has one.
#pragma once

#include <algorithm>
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
      add(event);
      size_ += event.num_events;
    }
    arrived_.notify_one();
  }

  bool dequeue(ExecutorEvent& event, std::chrono::nanoseconds timeout = std::chrono::nanoseconds::max()) override {
    std::unique_lock lock(mutex_);
    const auto has_event = [this] { return size_ > 0; };
    if (timeout == std::chrono::nanoseconds::max()) {
      arrived_.wait(lock, has_event);
    } else if (timeout > std::chrono::nanoseconds::zero()) {  // a wait for no time would still ask the kernel
      arrived_.wait_until(lock, std::chrono::steady_clock::now() + timeout, has_event);
    }
    if (size_ == 0) {
      return false;
    }
    event = turns_.front();
    turns_.pop_front();
    if (event.num_events > 1) {
      ExecutorEvent later = event;
      --later.num_events;
      turns_.push_back(later);
    }
    event.num_events = 1;
    --size_;
    return true;
  }

  bool empty() const override {
    const std::lock_guard lock(mutex_);
    return size_ == 0;
  }

  size_t size() const override {
    const std::lock_guard lock(mutex_);
    return size_;
  }

 private:
  // With the mutex held.
  void add(const ExecutorEvent& event) {
    const auto same = std::find_if(turns_.begin(), turns_.end(), [&event](const ExecutorEvent& other) {
      return other.entity_key == event.entity_key && other.type == event.type &&
             other.waitable_data == event.waitable_data;
    });
    if (same != turns_.end()) {
      same->num_events += event.num_events;
    } else if (event.num_events > 0) {
      turns_.push_back(event);
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<ExecutorEvent> turns_;  // in their order; one for each entity, with the number of its events
  size_t size_ = 0;                  // of all of them
};

}  // namespace rclcpp::experimental::executors
