// What a subscription is created with beside topic, QoS and callback.
#pragma once

#include "rclcpp/callback_group.hpp"
#include "rclcpp/event_handler.hpp"

namespace rclcpp {

struct SubscriptionOptions {
  // Null: the node's default group.
  CallbackGroup::SharedPtr callback_group;
  // Drops what publishers of the same context send.
  bool ignore_local_publications = false;
  // Whether events without a callback get the default one: a warning that an endpoint cannot match.
  bool use_default_callbacks = true;
  SubscriptionEventCallbacks event_callbacks;
};

}  // namespace rclcpp
