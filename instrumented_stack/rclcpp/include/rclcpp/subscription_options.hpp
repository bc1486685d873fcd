// What a subscription is created with beside topic, QoS and callback.
#pragma once

#include "rclcpp/callback_group.hpp"

namespace rclcpp {

struct SubscriptionOptions {
  // Null: the node's default group.
  CallbackGroup::SharedPtr callback_group;
  // Drops what publishers of the same context send.
  bool ignore_local_publications = false;
};

}  // namespace rclcpp
