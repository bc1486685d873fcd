// SPDX-License-Identifier: Apache-2.0
// Wakes an executor, or a WaitSet, from any thread.
#pragma once

#include <rcl/guard_condition.h>
#include <rcl/wait.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>

#include "rclcpp/context.hpp"
#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp {

class GuardCondition {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(GuardCondition)

  // The context must be initialized. Throws std::invalid_argument for null and exceptions::RCLInvalidArgument.
  explicit GuardCondition(const Context::SharedPtr& context = contexts::get_global_default_context(),
                          rcl_guard_condition_options_t options = rcl_guard_condition_get_default_options());
  ~GuardCondition();

  // Thread safe. Must not be called from a signal handler.
  void trigger();

  // For executors that are notified instead of waiting. From now on trigger() also calls `callback` with 1, in the
  // caller's thread; wait sets are still woken. The callback is called at once with the number of earlier triggers that
  // no callback heard. An empty callback ends the calls. Do not call this from the callback of another thread's
  // trigger.
  void set_on_trigger_callback(std::function<void(size_t)> callback);

  // Throws exceptions::RCLError.
  void add_to_wait_set(rcl_wait_set_t& wait_set);

  rcl_guard_condition_t& get_rcl_guard_condition() { return rcl_guard_condition_; }
  const rcl_guard_condition_t& get_rcl_guard_condition() const { return rcl_guard_condition_; }
  // Sets whether a wait set uses this; returns the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

 private:
  std::shared_ptr<rcl_context_t> rcl_context_;  // outlives the rcl guard condition
  rcl_guard_condition_t rcl_guard_condition_;
  std::atomic_bool in_use_by_wait_set_{false};
  std::recursive_mutex trigger_mutex_;  // recursive: a callback may trigger again
  std::function<void(size_t)> on_trigger_callback_;
  size_t unread_count_ = 0;
};

}  // namespace rclcpp
