// SPDX-License-Identifier: Apache-2.0
// One entity that is ready to be executed. At most one of the members is set.
#pragma once

#include <memory>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/client_base.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

// Holds its group: while it lives, no other entity of a mutually exclusive group is executed.
struct AnyExecutable {
  AnyExecutable() = default;
  ~AnyExecutable() { release_group(); }
  AnyExecutable(const AnyExecutable&) = delete;
  AnyExecutable& operator=(const AnyExecutable&) = delete;
  AnyExecutable(AnyExecutable&&) = default;
  AnyExecutable& operator=(AnyExecutable&&) = delete;

  void release_group() {
    if (callback_group) {
      callback_group->give_back();
      callback_group.reset();
    }
  }

  TimerBase::SharedPtr timer;
  SubscriptionBase::SharedPtr subscription;
  ServiceBase::SharedPtr service;
  ClientBase::SharedPtr client;
  Waitable::SharedPtr waitable;
  std::shared_ptr<void> data;  // for the timer or the waitable
  CallbackGroup::SharedPtr callback_group;
  node_interfaces::NodeBaseInterface::SharedPtr node_base;  // only memory strategies set it
};

}  // namespace rclcpp
