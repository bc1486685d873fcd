// SPDX-License-Identifier: Apache-2.0
// What is known of a thread between two of its events. Every part of the join has its members here, so that an event
// needs one search for its thread.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/model/execution/callback_tracker.hpp"
#include "tracing/model/execution/execution_tracker.hpp"
#include "tracing/model/execution/executor_waits.hpp"
#include "tracing/model/messages/intra_process_matcher.hpp"
#include "tracing/model/messages/message_matcher.hpp"

namespace tracing {

struct ThreadState {
  ActiveCallbacks callbacks;
  std::optional<ActiveExecution> execution;

  // Of the executor that spins in this thread.
  ThreadWaits waits;
  // rcl's handle of the timer or subscription that it executes: since its last wait, and until the callback begins.
  ros2::Handle executed = 0;

  // The thread's last rclcpp_publish and rcl_publish, which its rmw_publish follows.
  ros2::Handle rclcpp_message = 0;
  std::int64_t rclcpp_ns = 0;
  ros2::Handle rcl_publisher = 0;
  ros2::Handle rcl_message = 0;
  std::int64_t rcl_ns = 0;
  ObjectId written_topic = kNoObject;  // of the thread's last rmw_publish, which dds:write follows; kNoObject: it has
  std::uint64_t written_number = 0;
  std::optional<Publication> intra_process;  // the thread's last publication within the process
  std::optional<Publication> untimed;        // its last one without a timestamp, until it goes on

  // Messages that are not yet given to a callback.
  std::optional<TakenMessage> taken;
  ObjectId taken_for = kNoObject;           // the subscription that the executor executed then
  std::optional<BufferedMessage> buffered;  // from a ring buffer
  std::int64_t buffered_ns = 0;
};

}  // namespace tracing
