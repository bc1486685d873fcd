// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/hop_times.hpp"

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
  if (message.executor_waited_ns) {
    times.transport_ns = *message.executor_waited_ns;
    times.executor_ns = message.taken_ns - publication.published_ns - *times.transport_ns;
  }
  return times;
}

}  // namespace tracing
