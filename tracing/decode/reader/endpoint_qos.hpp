// SPDX-License-Identifier: Apache-2.0
// The quality of service of publishers and subscriptions, which provider `ros2_ext` records. ROS 2 records only the
// depth that the program asks for.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "tracing/decode/reader/handle_event_decoder.hpp"
#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::ros2 {

struct EndpointQos {
  bool reliable = false;
  std::uint64_t history_depth = 0;  // 0: all messages are kept
  bool is_filtered = false;         // by the content of messages; subscriptions only
  bool operator==(const EndpointQos&) const = default;
};

struct EndpointQosEvent {
  enum class Kind : std::uint8_t { kPublisher, kSubscription };
  Kind kind = Kind::kPublisher;
  Handle handle = 0;  // of rmw

  static constexpr std::array<std::pair<std::string_view, Kind>, 2> kKinds{{
      {"ros2_ext:rmw_publisher_qos", Kind::kPublisher},
      {"ros2_ext:rmw_subscription_qos", Kind::kSubscription},
  }};

  // Of the event that was decoded.
  static EndpointQos qos(const Event& event) {
    const auto number = [&event](std::string_view name) {
      const std::optional<FieldValue> value = event.field(name);
      return value ? value->unsigned_integer().value_or(0) : 0;
    };
    return {number("reliable") != 0, number("history_depth"), number("is_filtered") != 0};
  }
};

using EndpointQosDecoder = HandleEventDecoder<EndpointQosEvent>;

}  // namespace tracing::ros2
