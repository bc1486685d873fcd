// Wakes an executor, or a WaitSet, from any thread.
#pragma once

#include <rcl/guard_condition.h>

#include <atomic>
#include <memory>

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
  // Sets whether a wait set uses this; the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

 private:
  std::shared_ptr<rcl_context_t> rcl_context_;  // outlives the rcl guard condition
  rcl_guard_condition_t rcl_guard_condition_;
  std::atomic_bool in_use_by_wait_set_{false};
};

}  // namespace rclcpp
