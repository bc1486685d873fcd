// SPDX-License-Identifier: Apache-2.0
// Steps of executors and clients for which ROS 2 has no event. Provider `ros2_ext` records them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "tracing/decode/reader/handle_event_decoder.hpp"
#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::ros2 {

struct ExecutionEvent {
  enum class Kind : std::uint8_t {
    kService,              // an executor begins to serve a service: rclcpp_executor_execute_service
    kClient,               // rclcpp_executor_execute_client
    kWaitable,             // rclcpp_executor_execute_waitable
    kClientCallbackStart,  // a client hands out a response: rclcpp_client_callback_start
    kClientCallbackEnd,
  };
  Kind kind = Kind::kService;
  Handle handle = 0;  // rcl's handle of the service or the client, or the address of the waitable

  static constexpr std::array<std::pair<std::string_view, Kind>, 5> kKinds{{
      {"ros2_ext:rclcpp_executor_execute_service", Kind::kService},
      {"ros2_ext:rclcpp_executor_execute_client", Kind::kClient},
      {"ros2_ext:rclcpp_executor_execute_waitable", Kind::kWaitable},
      {"ros2_ext:rclcpp_client_callback_start", Kind::kClientCallbackStart},
      {"ros2_ext:rclcpp_client_callback_end", Kind::kClientCallbackEnd},
  }};

  bool operator==(const ExecutionEvent&) const = default;
};

using ExecutionEventDecoder = HandleEventDecoder<ExecutionEvent>;

}  // namespace tracing::ros2
