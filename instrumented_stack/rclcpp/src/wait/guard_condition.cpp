// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/guard_condition.hpp"

#include <stdexcept>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"

namespace rclcpp {

using detail::require_ok;

GuardCondition::GuardCondition(const Context::SharedPtr& context, rcl_guard_condition_options_t options)
    : rcl_context_(context ? context->get_rcl_context() : nullptr),
      rcl_guard_condition_(rcl_get_zero_initialized_guard_condition()) {
  if (!context) {
    throw std::invalid_argument("context argument unexpectedly nullptr");
  }
  require_ok(rcl_guard_condition_init(&rcl_guard_condition_, rcl_context_.get(), options),
             "failed to create guard condition");
}

GuardCondition::~GuardCondition() {
  detail::log_error(rcl_guard_condition_fini(&rcl_guard_condition_), "failed to finalize guard condition");
}

void GuardCondition::trigger() {
  require_ok(rcl_trigger_guard_condition(&rcl_guard_condition_), "failed to trigger guard condition");
  const std::lock_guard lock(trigger_mutex_);
  if (on_trigger_callback_) {
    on_trigger_callback_(1);
  } else {
    ++unread_count_;
  }
}

void GuardCondition::set_on_trigger_callback(std::function<void(size_t)> callback) {
  const std::lock_guard lock(trigger_mutex_);
  on_trigger_callback_ = std::move(callback);
  if (on_trigger_callback_ && unread_count_ > 0) {
    on_trigger_callback_(std::exchange(unread_count_, 0));
  }
}

void GuardCondition::add_to_wait_set(rcl_wait_set_t& wait_set) {
  require_ok(rcl_wait_set_add_guard_condition(&wait_set, &rcl_guard_condition_, nullptr),
             "failed to add guard condition to wait set");
}

}  // namespace rclcpp
