// SPDX-License-Identifier: Apache-2.0
// Where an events executor gets its events from. Derive from it for another order than that of arrival.
#pragma once

#include <chrono>
#include <cstddef>

#include "rclcpp/experimental/executors/events_executor/events_executor_event_types.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp::experimental::executors {

// Thread safe.
class EventsQueue {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(EventsQueue)

  EventsQueue() = default;
  virtual ~EventsQueue() = default;
  RCLCPP_DISABLE_COPY(EventsQueue)

  // Called by threads of the middleware: it must not block.
  virtual void enqueue(const ExecutorEvent& event) = 0;

  // The next event; waits for it up to `timeout`, the largest value for ever. False if there was none.
  virtual bool dequeue(ExecutorEvent& event, std::chrono::nanoseconds timeout = std::chrono::nanoseconds::max()) = 0;

  virtual bool empty() const = 0;
  // In events, each for one execution.
  virtual size_t size() const = 0;
};

}  // namespace rclcpp::experimental::executors
