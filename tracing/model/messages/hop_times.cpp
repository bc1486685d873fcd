// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/hop_times.hpp"

#include <algorithm>

namespace tracing {

HopTimes hop_times(const MessageFlow& message) {
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
  if (message.executor_free_ns == 0) {
    return times;  // no executor that tells
  }
  const std::int64_t woken = message.executor_woken_ns == 0 ? message.taken_ns : message.executor_woken_ns;
  const std::int64_t waited = woken - std::max(publication.published_ns, message.executor_free_ns);
  times.transport_ns = publication.intra_process ? 0 : std::max<std::int64_t>(waited, 0);
  times.executor_ns = message.taken_ns - publication.published_ns - *times.transport_ns;
  return times;
}

}  // namespace tracing
