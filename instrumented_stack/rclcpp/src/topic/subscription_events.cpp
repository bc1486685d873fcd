// SPDX-License-Identifier: Apache-2.0
// The event handlers of subscriptions.
#include <stdexcept>
#include <string>
#include <utility>

#include "rclcpp/logging.hpp"
#include "rclcpp/subscription_base.hpp"
#include "topic/on_event.hpp"

namespace rclcpp {

void SubscriptionBase::bind_event_callbacks(const SubscriptionEventCallbacks& callbacks, bool use_default_callbacks,
                                            const std::string& logger_name) {
  if (callbacks.deadline_callback) {
    add_event_handler(callbacks.deadline_callback, RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED);
  }
  if (callbacks.liveliness_callback) {
    add_event_handler(callbacks.liveliness_callback, RCL_SUBSCRIPTION_LIVELINESS_CHANGED);
  }
  if (callbacks.incompatible_qos_callback) {
    add_event_handler(callbacks.incompatible_qos_callback, RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS);
  } else if (use_default_callbacks) {
    const QOSRequestedIncompatibleQoSCallbackType warn = [topic = std::string(get_topic_name()),
                                                          logger_name](const QOSRequestedIncompatibleQoSInfo& event) {
      RCLCPP_WARN(
          get_logger(logger_name),
          "New publisher discovered on topic '%s', offering incompatible QoS. No messages will be received from "
          "it. Last incompatible policy: %s",
          topic.c_str(), qos_policy_name_from_kind(event.last_policy_kind).c_str());
    };
    add_event_handler(warn, RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS);
  }
  if (callbacks.message_lost_callback) {
    add_event_handler(callbacks.message_lost_callback, RCL_SUBSCRIPTION_MESSAGE_LOST);
  }
  if (callbacks.incompatible_type_callback) {
    add_event_handler(callbacks.incompatible_type_callback, RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE);
  } else if (use_default_callbacks) {
    const IncompatibleTypeCallbackType warn = [topic = std::string(get_topic_name()),
                                               logger_name](IncompatibleTypeInfo&) {
      RCLCPP_WARN(get_logger(logger_name), "Incompatible type on topic '%s', no messages will be received from it.",
                  topic.c_str());
    };
    add_event_handler(warn, RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE);
  }
  if (callbacks.matched_callback) {
    add_event_handler(callbacks.matched_callback, RCL_SUBSCRIPTION_MATCHED);
  }
}

template <typename EventCallbackT>
void SubscriptionBase::add_event_handler(const EventCallbackT& callback, rcl_subscription_event_type_t event_type) {
  event_handlers_.insert_or_assign(event_type,
                                   std::make_shared<EventHandler<EventCallbackT, std::shared_ptr<rcl_subscription_t>>>(
                                       callback, rcl_subscription_event_init, subscription_handle_, event_type));
}

void SubscriptionBase::set_on_new_qos_event_callback(std::function<void(size_t)> callback,
                                                     rcl_subscription_event_type_t event_type) {
  detail::set_on_event(event_handlers_, event_type, std::move(callback), "subscription");
}

void SubscriptionBase::clear_on_new_qos_event_callback(rcl_subscription_event_type_t event_type) {
  detail::clear_on_event(event_handlers_, event_type);
}

void SubscriptionBase::set_on_new_intra_process_message_callback(std::function<void(size_t)> callback) {
  if (!callback) {
    throw std::invalid_argument("The callback passed to set_on_new_intra_process_message_callback is not callable.");
  }
  const std::shared_ptr<Waitable> waitable = get_intra_process_waitable();
  if (!waitable) {
    RCLCPP_WARN(get_logger("rclcpp"),
                "Calling set_on_new_intra_process_message_callback for subscription with IPC disabled");
    return;
  }
  waitable->set_on_ready_callback([callback = std::move(callback)](size_t count, int) { callback(count); });
}

void SubscriptionBase::clear_on_new_intra_process_message_callback() {
  const std::shared_ptr<Waitable> waitable = get_intra_process_waitable();
  if (!waitable) {
    RCLCPP_WARN(get_logger("rclcpp"),
                "Calling clear_on_new_intra_process_message_callback for subscription with IPC disabled");
    return;
  }
  waitable->clear_on_ready_callback();
}

}  // namespace rclcpp
