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
HopTimes hop_times(const MessageFlow& message);

}  // namespace tracing
