// SPDX-License-Identifier: Apache-2.0
// The queue of an events executor. Derive from it to use another order than that of arrival.
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

  // Takes the next event. Waits for it up to `timeout`; the largest value waits forever. Returns false if there was
  // none.
  virtual bool dequeue(ExecutorEvent& event, std::chrono::nanoseconds timeout = std::chrono::nanoseconds::max()) = 0;

  virtual bool empty() const = 0;
  // The number of events. Each counts for one execution.
  virtual size_t size() const = 0;
};

}  // namespace rclcpp::experimental::executors
