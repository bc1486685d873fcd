// SPDX-License-Identifier: Apache-2.0
// The kinds of ROS 2 objects that a trace tells of, as ObjectModel keeps them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tracing/decode/reader/ext_events.hpp"
#include "tracing/decode/reader/ros2_events.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

using ObjectId = std::uint32_t;  // index in the lists of ObjectModel
inline constexpr ObjectId kNoObject = 0xffffffff;

// Where and when an event was recorded.
struct Origin {
  std::int64_t time_ns = 0;
  ProcessId process = 0;
  std::int64_t vtid = 0;
};

struct NodeObject {
  ProcessId process = kNoProcess;
  std::string name;  // fully qualified: "/ns/ping"
};

struct TopicObject {
  std::string name;
  std::uint32_t publishers = 0;
  std::uint32_t subscriptions = 0;
};

struct EndpointObject {  // publisher or subscription
  ObjectId node = kNoObject;
  ObjectId topic = kNoObject;
  std::uint64_t queue_depth = 0;                        // as the program asked for it
  std::optional<ros2::EndpointQos> qos = std::nullopt;  // if the trace has it
  ProcessId process = kNoProcess;                       // known even if the node is not
  bool operator==(const EndpointObject&) const = default;
};

// rclcpp's object around a subscription: there is one, or two with intra-process communication.
struct SubscriptionObject {
  ObjectId subscription = kNoObject;
  bool has_callback = false;
  bool callback_repeated = false;  // belongs to this object, unless the next rclcpp_subscription_init names another
};

struct TimerObject {
  ObjectId node = kNoObject;
  std::int64_t period_ns = 0;
};

struct ServiceObject {
  ObjectId node = kNoObject;
  std::string name;
  bool operator==(const ServiceObject&) const = default;
};

struct ClientObject {
  ObjectId node = kNoObject;
  std::string name;  // of the service
  ros2::Gid gid;     // size 0 when its rmw_client_init is not in the trace
  bool operator==(const ClientObject&) const = default;
};

struct CallbackObject {
  enum class Owner { kUnknown, kSubscription, kTimer, kService, kClient };
  ProcessId process = kNoProcess;
  ros2::Handle address = 0;  // for a client's callback: rcl's handle of the client
  Owner owner = Owner::kUnknown;
  ObjectId owner_id = kNoObject;  // of a subscription object, timer, service or client
  std::string symbol;             // as recorded, may be empty
};

}  // namespace tracing
