// SPDX-License-Identifier: Apache-2.0
// Where the time of one message goes on its way to one callback. delivery_statistics.hpp explains the parts.
#pragma once

#include <cstdint>
#include <optional>

#include "tracing/model/execution/execution_sink.hpp"

namespace tracing {

// Nanoseconds. A part is nullopt when the trace does not tell.
struct HopTimes {
  std::int64_t latency_ns = 0;  // from the first publish function in the trace to the begin of the callback
  std::optional<std::int64_t> rclcpp_ns;
  std::optional<std::int64_t> rcl_ns;
  std::optional<std::int64_t> transport_ns;
  std::optional<std::int64_t> executor_ns;
  std::int64_t take_ns = 0;
};

// Of a message whose publication is in the trace and that a callback got.
inline HopTimes hop_times(const MessageFlow& message) {
  const Publication& publication = message.publication;
  HopTimes times;
  std::int64_t begin = publication.published_ns;
  if (publication.rcl_ns != 0) {
    times.rcl_ns = begin - publication.rcl_ns;
    begin = publication.rcl_ns;
  }
  if (publication.rclcpp_ns != 0 && publication.rcl_ns != 0) {
    times.rclcpp_ns = publication.rcl_ns - publication.rclcpp_ns;
    begin = publication.rclcpp_ns;
  }
  times.latency_ns = message.callback_begin_ns - begin;
  times.take_ns = message.callback_begin_ns - message.taken_ns;
  if (message.executor_waited_ns) {
    times.transport_ns = *message.executor_waited_ns;
    times.executor_ns = message.taken_ns - publication.published_ns - *times.transport_ns;
  }
  return times;
}

}  // namespace tracing
