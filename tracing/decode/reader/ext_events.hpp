// SPDX-License-Identifier: Apache-2.0
// The events of provider `ros2_ext` whose first field is the handle of their object: what ROS 2 itself does not record.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "tracing/decode/reader/event.hpp"
#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::ros2 {

// For the events of one reader. A `Decoded` has a `kind`, a `handle`, and kKinds: pairs of an event's name and its
// kind.
template <typename Decoded>
class HandleEventDecoder {
 public:
  // Returns nothing for another event.
  std::optional<Decoded> decode(const Event& event) {
    const Kind& kind = kinds_.of(*event.event_class, [&] { return kind_of(event); });
    if (!kind || event.event_class->fields.empty()) {
      return std::nullopt;
    }
    const std::optional<std::uint64_t> handle = event.field(0).unsigned_integer();
    if (!handle) {
      return std::nullopt;
    }
    return Decoded{*kind, *handle};
  }

 private:
  using Kind = std::optional<typename Decoded::Kind>;

  static Kind kind_of(const Event& event) {
    const auto found = std::find_if(Decoded::kKinds.begin(), Decoded::kKinds.end(),
                                    [&](const auto& entry) { return entry.first == event.name(); });
    return found == Decoded::kKinds.end() ? std::nullopt : Kind(found->second);
  }

  ByEventClass<Kind> kinds_;
};

// The end of an object; ROS 2 itself records only beginnings. After this event the handle may belong to another object.
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

// A step of an executor or a client.
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

// The quality of service of a publisher or a subscription. ROS 2 records only the depth that the program asks for.
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
      return static_cast<std::uint64_t>(value ? value->integer().value_or(0) : 0);
    };
    return {number("reliable") != 0, number("history_depth"), number("is_filtered") != 0};
  }
};

using EndpointQosDecoder = HandleEventDecoder<EndpointQosEvent>;

// The state of a lifecycle node that is older than the session, from a state dump.
struct LifecycleState {
  enum class Kind : std::uint8_t { kCurrent };
  Kind kind = Kind::kCurrent;
  Handle state_machine = 0;

  static constexpr std::array<std::pair<std::string_view, Kind>, 1> kKinds{
      {{"ros2_ext:rcl_lifecycle_state", Kind::kCurrent}}};

  // Of the event that was decoded: "active".
  static std::string_view label(const Event& event) {
    const std::optional<FieldValue> value = event.field("label");
    return value ? value->string().value_or("") : "";
  }
};

using LifecycleStateDecoder = HandleEventDecoder<LifecycleState>;

}  // namespace tracing::ros2
