// One thing that is ready to be executed. At most one of the entities is set.
#pragma once

#include <memory>

#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {

struct AnyExecutable {
  TimerBase::SharedPtr timer;
  SubscriptionBase::SharedPtr subscription;
};

}  // namespace rclcpp
