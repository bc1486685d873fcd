// SPDX-License-Identifier: Apache-2.0
// An entity that an executor's wait can find ready. Held weakly, so that a user's reset() destroys it at once.
#pragma once

#include <cstdint>
#include <variant>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/client_base.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp::detail {

using AnyEntity = std::variant<TimerBase::WeakPtr, SubscriptionBase::WeakPtr, ServiceBase::WeakPtr, ClientBase::WeakPtr,
                               Waitable::WeakPtr>;

struct ReadyEntity {
  AnyEntity entity;
  CallbackGroup::WeakPtr group;
  std::uint64_t turn = 0;  // of several, the lowest one goes first
};

}  // namespace rclcpp::detail
