// What a publisher is created with beside topic and QoS.
#pragma once

#include "rclcpp/callback_group.hpp"
#include "rclcpp/event_handler.hpp"

namespace rclcpp {

struct PublisherOptionsBase {
  // Whether events without a callback get the default one: a warning that an endpoint cannot match.
  bool use_default_callbacks = true;
  PublisherEventCallbacks event_callbacks;
  // Where the event callbacks run. Null: the node's default group.
  CallbackGroup::SharedPtr callback_group;
};

struct PublisherOptions : PublisherOptionsBase {};

}  // namespace rclcpp
