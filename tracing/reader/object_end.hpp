// The ends of ROS 2 objects, which provider `ros2_ext` records. ROS 2 itself tells of beginnings only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracing/reader/event.hpp"
#include "tracing/reader/ros2_events.hpp"

namespace tracing::ros2 {

// From here on the handle may be that of another object.
struct ObjectEnd {
  // Of what the init event of this name told: rcl_node_init, rmw_publisher_init, …, rclcpp_subscription_init,
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
  };
  Kind kind = Kind::kRclNode;
  Handle handle = 0;
  bool operator==(const ObjectEnd&) const = default;
};

// For the events of one reader.
class ObjectEndDecoder {
 public:
  // Nothing when it is another event.
  std::optional<ObjectEnd> decode(const Event& event);

 private:
  using Kind = std::optional<ObjectEnd::Kind>;
  std::vector<std::optional<Kind>> kinds_;  // by EventClass::id, as far as asked for
};

}  // namespace tracing::ros2
