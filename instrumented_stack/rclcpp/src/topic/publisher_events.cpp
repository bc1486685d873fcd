// SPDX-License-Identifier: Apache-2.0
// The event handlers of publishers.
#include <string>
#include <utility>

#include "rclcpp/logging.hpp"
#include "rclcpp/publisher_base.hpp"
#include "topic/on_event.hpp"

namespace rclcpp {

void PublisherBase::bind_event_callbacks(const PublisherEventCallbacks& callbacks, bool use_default_callbacks,
                                         const std::string& logger_name) {
  if (callbacks.deadline_callback) {
    add_event_handler(callbacks.deadline_callback, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED);
  }
  if (callbacks.liveliness_callback) {
    add_event_handler(callbacks.liveliness_callback, RCL_PUBLISHER_LIVELINESS_LOST);
  }
  if (callbacks.incompatible_qos_callback) {
    add_event_handler(callbacks.incompatible_qos_callback, RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS);
  } else if (use_default_callbacks) {
    const QOSOfferedIncompatibleQoSCallbackType warn = [topic = std::string(get_topic_name()),
                                                        logger_name](const QOSOfferedIncompatibleQoSInfo& event) {
      RCLCPP_WARN(get_logger(logger_name),
                  "New subscription discovered on topic '%s', requesting incompatible QoS. No messages will be sent to "
                  "it. Last incompatible policy: %s",
                  topic.c_str(), qos_policy_name_from_kind(event.last_policy_kind).c_str());
    };
    add_event_handler(warn, RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS);
  }
  if (callbacks.incompatible_type_callback) {
    add_event_handler(callbacks.incompatible_type_callback, RCL_PUBLISHER_INCOMPATIBLE_TYPE);
  } else if (use_default_callbacks) {
    const IncompatibleTypeCallbackType warn = [topic = std::string(get_topic_name()),
                                               logger_name](IncompatibleTypeInfo&) {
      RCLCPP_WARN(get_logger(logger_name), "Incompatible type on topic '%s', no messages will be sent to it.",
                  topic.c_str());
    };
    add_event_handler(warn, RCL_PUBLISHER_INCOMPATIBLE_TYPE);
  }
  if (callbacks.matched_callback) {
    add_event_handler(callbacks.matched_callback, RCL_PUBLISHER_MATCHED);
  }
}

template <typename EventCallbackT>
void PublisherBase::add_event_handler(const EventCallbackT& callback, rcl_publisher_event_type_t event_type) {
  event_handlers_.insert_or_assign(event_type,
                                   std::make_shared<EventHandler<EventCallbackT, std::shared_ptr<rcl_publisher_t>>>(
                                       callback, rcl_publisher_event_init, publisher_handle_, event_type));
}

void PublisherBase::set_on_new_qos_event_callback(std::function<void(size_t)> callback,
                                                  rcl_publisher_event_type_t event_type) {
  detail::set_on_event(event_handlers_, event_type, std::move(callback), "publisher");
}

void PublisherBase::clear_on_new_qos_event_callback(rcl_publisher_event_type_t event_type) {
  detail::clear_on_event(event_handlers_, event_type);
}

}  // namespace rclcpp
