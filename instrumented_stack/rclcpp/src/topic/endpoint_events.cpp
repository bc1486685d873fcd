// SPDX-License-Identifier: Apache-2.0
// The event handlers of publishers and subscriptions, and functions that a program sets for events beside them.
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "rclcpp/logging.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/subscription_base.hpp"

namespace rclcpp {

namespace {

// How warnings speak of the endpoints at the other end.
struct OtherEnd {
  const char* kind;
  const char* qos_is;
  const char* messages_are;
};
constexpr OtherEnd kSubscriptions{"subscription", "requesting", "sent to"};
constexpr OtherEnd kPublishers{"publisher", "offering", "received from"};

// `callback`, or a warning if there is none and there are to be such.
template <typename CallbackT>
CallbackT or_warn_of_qos(const CallbackT& callback, bool use_default, const std::string& logger_name,
                         const std::string& topic, const OtherEnd& other) {
  if (callback || !use_default) {
    return callback;
  }
  return [logger_name, topic, &other](const auto& event) {
    RCLCPP_WARN(get_logger(logger_name),
                "New %s discovered on topic '%s', %s incompatible QoS. No messages will be %s it. Last incompatible "
                "policy: %s",
                other.kind, topic.c_str(), other.qos_is, other.messages_are,
                qos_policy_name_from_kind(event.last_policy_kind).c_str());
  };
}

IncompatibleTypeCallbackType or_warn_of_type(const IncompatibleTypeCallbackType& callback, bool use_default,
                                             const std::string& logger_name, const std::string& topic,
                                             const OtherEnd& other) {
  if (callback || !use_default) {
    return callback;
  }
  return [logger_name, topic, &other](IncompatibleTypeInfo&) {
    RCLCPP_WARN(get_logger(logger_name), "Incompatible type on topic '%s', no messages will be %s it.", topic.c_str(),
                other.messages_are);
  };
}

template <typename HandleT, typename HandlersT, typename CallbackT, typename InitT, typename EventTypeT>
void add_handler(HandlersT& handlers, const CallbackT& callback, InitT init, const HandleT& parent, EventTypeT type) {
  if (callback) {
    handlers.insert_or_assign(type, std::make_shared<EventHandler<CallbackT, HandleT>>(callback, init, parent, type));
  }
}

template <typename HandlersT, typename EventTypeT>
void set_on_event(const HandlersT& handlers, EventTypeT event_type, std::function<void(size_t)> callback,
                  const char* kind) {
  const auto handler = handlers.find(event_type);
  if (handler == handlers.end()) {
    RCLCPP_WARN(get_logger("rclcpp"), "Calling set_on_new_qos_event_callback for non registered %s event_type", kind);
    return;
  }
  if (!callback) {
    throw std::invalid_argument("The callback passed to set_on_new_qos_event_callback is not callable.");
  }
  handler->second->set_on_ready_callback([callback = std::move(callback)](size_t count, int) { callback(count); });
}

template <typename HandlersT, typename EventTypeT>
void clear_on_event(const HandlersT& handlers, EventTypeT event_type) {
  const auto handler = handlers.find(event_type);
  if (handler == handlers.end()) {
    RCLCPP_WARN(get_logger("rclcpp"), "Calling clear_on_new_qos_event_callback for non registered event_type");
    return;
  }
  handler->second->clear_on_ready_callback();
}

}  // namespace

void PublisherBase::default_incompatible_qos_callback(QOSOfferedIncompatibleQoSInfo& info) const {
  const QOSOfferedIncompatibleQoSCallbackType none;
  or_warn_of_qos(none, true, "rclcpp", get_topic_name(), kSubscriptions)(info);
}

void PublisherBase::bind_event_callbacks(const PublisherEventCallbacks& callbacks, bool use_default_callbacks,
                                         const std::string& logger_name) {
  const auto add = [this](const auto& callback, rcl_publisher_event_type_t type) {
    add_handler(event_handlers_, callback, rcl_publisher_event_init, publisher_handle_, type);
  };
  const std::string topic = get_topic_name();
  add(callbacks.deadline_callback, RCL_PUBLISHER_OFFERED_DEADLINE_MISSED);
  add(callbacks.liveliness_callback, RCL_PUBLISHER_LIVELINESS_LOST);
  add(or_warn_of_qos(callbacks.incompatible_qos_callback, use_default_callbacks, logger_name, topic, kSubscriptions),
      RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS);
  add(or_warn_of_type(callbacks.incompatible_type_callback, use_default_callbacks, logger_name, topic, kSubscriptions),
      RCL_PUBLISHER_INCOMPATIBLE_TYPE);
  add(callbacks.matched_callback, RCL_PUBLISHER_MATCHED);
}

void SubscriptionBase::bind_event_callbacks(const SubscriptionEventCallbacks& callbacks, bool use_default_callbacks,
                                            const std::string& logger_name) {
  const auto add = [this](const auto& callback, rcl_subscription_event_type_t type) {
    add_handler(event_handlers_, callback, rcl_subscription_event_init, subscription_handle_, type);
  };
  const std::string topic = get_topic_name();
  add(callbacks.deadline_callback, RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED);
  add(callbacks.liveliness_callback, RCL_SUBSCRIPTION_LIVELINESS_CHANGED);
  add(or_warn_of_qos(callbacks.incompatible_qos_callback, use_default_callbacks, logger_name, topic, kPublishers),
      RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS);
  add(callbacks.message_lost_callback, RCL_SUBSCRIPTION_MESSAGE_LOST);
  add(or_warn_of_type(callbacks.incompatible_type_callback, use_default_callbacks, logger_name, topic, kPublishers),
      RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE);
  add(callbacks.matched_callback, RCL_SUBSCRIPTION_MATCHED);
}

void PublisherBase::set_on_new_qos_event_callback(std::function<void(size_t)> callback,
                                                  rcl_publisher_event_type_t event_type) {
  set_on_event(event_handlers_, event_type, std::move(callback), "publisher");
}

void PublisherBase::clear_on_new_qos_event_callback(rcl_publisher_event_type_t event_type) {
  clear_on_event(event_handlers_, event_type);
}

void SubscriptionBase::set_on_new_qos_event_callback(std::function<void(size_t)> callback,
                                                     rcl_subscription_event_type_t event_type) {
  set_on_event(event_handlers_, event_type, std::move(callback), "subscription");
}

void SubscriptionBase::clear_on_new_qos_event_callback(rcl_subscription_event_type_t event_type) {
  clear_on_event(event_handlers_, event_type);
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
