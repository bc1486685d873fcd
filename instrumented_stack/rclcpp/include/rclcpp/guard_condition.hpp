// Wakes an executor from any thread.
#pragma once

#include <rcl/guard_condition.h>

#include "rclcpp/context.hpp"
#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp {

class GuardCondition {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(GuardCondition)

  // The context must be initialized: throws exceptions::RCLInvalidArgument or std::invalid_argument.
  explicit GuardCondition(const Context::SharedPtr& context = contexts::get_global_default_context());
  ~GuardCondition();

  // Thread safe. Not to be called from a signal handler.
  void trigger();

  const rcl_guard_condition_t& get_rcl_guard_condition() const { return rcl_guard_condition_; }

 private:
  std::shared_ptr<rcl_context_t> rcl_context_;  // outlives the rcl guard condition
  rcl_guard_condition_t rcl_guard_condition_;
};

}  // namespace rclcpp
