// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/experimental/subscription_intra_process_base.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/topic_statistics/subscription_topic_statistics.hpp"

namespace rclcpp::experimental {

namespace {

constexpr int kSubscription = static_cast<int>(SubscriptionIntraProcessBase::EntityType::Subscription);

}  // namespace

void SubscriptionIntraProcessBase::add_to_wait_set(rcl_wait_set_t& wait_set) {
  // A wait resets the trigger, but the executor may have taken only one of several messages.
  if (has_data()) {
    guard_condition_.trigger();
  }
  detail::require_ok(rcl_wait_set_add_guard_condition(&wait_set, &guard_condition_.get_rcl_guard_condition(), nullptr),
                     "failed to add guard condition to wait set");
}

bool SubscriptionIntraProcessBase::is_ready(const rcl_wait_set_t& /*wait_set*/) {
  return has_data();
}

std::shared_ptr<void> SubscriptionIntraProcessBase::take_data_by_entity_id(size_t /*id*/) {
  return take_data();
}

void SubscriptionIntraProcessBase::execute(const std::shared_ptr<void>& data) {
  if (!data || !has_callbacks_) {
    return;
  }
  MessageInfo message_info;
  message_info.get_rmw_message_info().from_intra_process = true;
  if (!statistics_) {
    dispatch(data, message_info);
    return;
  }
  // Measured before the callback, so that its running time does not count.
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  dispatch(data, message_info);
  statistics_->handle_message(message_info.get_rmw_message_info(),
                              Time(std::chrono::nanoseconds(now).count(), RCL_SYSTEM_TIME));
}

void SubscriptionIntraProcessBase::set_on_ready_callback(std::function<void(size_t, int)> callback) {
  if (!callback) {
    throw std::invalid_argument("The callback passed to set_on_ready_callback is not callable.");
  }
  const std::lock_guard lock(callback_mutex_);
  on_ready_ = std::move(callback);
  if (unread_count_ > 0) {
    on_ready_(std::min(std::exchange(unread_count_, 0), qos_.depth()), kSubscription);
  }
}

void SubscriptionIntraProcessBase::clear_on_ready_callback() {
  const std::lock_guard lock(callback_mutex_);
  on_ready_ = nullptr;
}

void SubscriptionIntraProcessBase::notify() {
  guard_condition_.trigger();
  const std::lock_guard lock(callback_mutex_);
  if (on_ready_) {
    on_ready_(1, kSubscription);
  } else {
    ++unread_count_;
  }
}

}  // namespace rclcpp::experimental
