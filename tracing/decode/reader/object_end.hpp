// SPDX-License-Identifier: Apache-2.0
// The ends of ROS 2 objects, which provider `ros2_ext` records. ROS 2 itself records only beginnings.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "tracing/decode/reader/handle_event_decoder.hpp"
#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::ros2 {

// After this event the handle may belong to another object.
struct ObjectEnd {
  // The kind of object, by its init event: rcl_node_init, rmw_publisher_init, …, rclcpp_subscription_init,
  // rclcpp_callback_register.
  enum class Kind : std::uint8_t {
    kRclNode,
    kRmwPublisher,
    kRclPublisher,
    kRmwSubscription,
    kRclSubscription,
    kRclcppSubscription,
    kRclService,
    kRmwService,
    kRclClient,
    kRmwClient,
    kRclTimer,
    kRclcppCallback,
    kRclLifecycleStateMachine,
  };
  Kind kind = Kind::kRclNode;
  Handle handle = 0;

  static constexpr std::array<std::pair<std::string_view, Kind>, 13> kKinds{{
      {"ros2_ext:rcl_node_fini", Kind::kRclNode},
      {"ros2_ext:rmw_publisher_fini", Kind::kRmwPublisher},
      {"ros2_ext:rcl_publisher_fini", Kind::kRclPublisher},
      {"ros2_ext:rmw_subscription_fini", Kind::kRmwSubscription},
      {"ros2_ext:rcl_subscription_fini", Kind::kRclSubscription},
      {"ros2_ext:rclcpp_subscription_fini", Kind::kRclcppSubscription},
      {"ros2_ext:rcl_service_fini", Kind::kRclService},
      {"ros2_ext:rmw_service_fini", Kind::kRmwService},
      {"ros2_ext:rcl_client_fini", Kind::kRclClient},
      {"ros2_ext:rmw_client_fini", Kind::kRmwClient},
      {"ros2_ext:rcl_timer_fini", Kind::kRclTimer},
      {"ros2_ext:rclcpp_callback_fini", Kind::kRclcppCallback},
      {"ros2_ext:rcl_lifecycle_state_machine_fini", Kind::kRclLifecycleStateMachine},
  }};

  bool operator==(const ObjectEnd&) const = default;
};

using ObjectEndDecoder = HandleEventDecoder<ObjectEnd>;

}  // namespace tracing::ros2
