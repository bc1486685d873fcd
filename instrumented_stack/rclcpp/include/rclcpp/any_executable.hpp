// One thing that is ready to be executed. At most one of the entities is set.
#pragma once

#include <memory>

#include "rclcpp/client_base.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {

struct AnyExecutable {
  TimerBase::SharedPtr timer;
  SubscriptionBase::SharedPtr subscription;
  ServiceBase::SharedPtr service;
  ClientBase::SharedPtr client;
};

}  // namespace rclcpp
