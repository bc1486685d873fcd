// One thing that is ready to be executed. At most one of the entities is set.
#pragma once

#include <memory>

#include "rclcpp/client_base.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

struct AnyExecutable {
  TimerBase::SharedPtr timer;
  SubscriptionBase::SharedPtr subscription;
  ServiceBase::SharedPtr service;
  ClientBase::SharedPtr client;
  Waitable::SharedPtr waitable;
  std::shared_ptr<void> data;  // what the waitable's take_data() gave
};

}  // namespace rclcpp
