// SPDX-License-Identifier: Apache-2.0
// Events of publishers and subscriptions besides messages: missed deadlines, liveliness, incompatible endpoints, lost
// messages, matches. Their callbacks are in PublisherOptions and SubscriptionOptions.
#pragma once

#include <rcl/event.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/detail/on_ready_callback.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/function_traits.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

using QOSDeadlineRequestedInfo = rmw_requested_deadline_missed_status_t;
using QOSDeadlineOfferedInfo = rmw_offered_deadline_missed_status_t;
using QOSLivelinessChangedInfo = rmw_liveliness_changed_status_t;
using QOSLivelinessLostInfo = rmw_liveliness_lost_status_t;
using QOSMessageLostInfo = rmw_message_lost_status_t;
using QOSOfferedIncompatibleQoSInfo = rmw_offered_qos_incompatible_event_status_t;
using QOSRequestedIncompatibleQoSInfo = rmw_requested_qos_incompatible_event_status_t;
using IncompatibleTypeInfo = rmw_incompatible_type_status_t;
using MatchedInfo = rmw_matched_status_t;

using QOSDeadlineRequestedCallbackType = std::function<void(QOSDeadlineRequestedInfo&)>;
using QOSDeadlineOfferedCallbackType = std::function<void(QOSDeadlineOfferedInfo&)>;
using QOSLivelinessChangedCallbackType = std::function<void(QOSLivelinessChangedInfo&)>;
using QOSLivelinessLostCallbackType = std::function<void(QOSLivelinessLostInfo&)>;
using QOSMessageLostCallbackType = std::function<void(QOSMessageLostInfo&)>;
using QOSOfferedIncompatibleQoSCallbackType = std::function<void(QOSOfferedIncompatibleQoSInfo&)>;
using QOSRequestedIncompatibleQoSCallbackType = std::function<void(QOSRequestedIncompatibleQoSInfo&)>;
using IncompatibleTypeCallbackType = std::function<void(IncompatibleTypeInfo&)>;
using PublisherMatchedCallbackType = std::function<void(MatchedInfo&)>;
using SubscriptionMatchedCallbackType = std::function<void(MatchedInfo&)>;

// Empty callbacks are not called. With use_default_callbacks in the options, an empty incompatible_qos_callback becomes
// a warning in the log.
struct PublisherEventCallbacks {
  QOSDeadlineOfferedCallbackType deadline_callback;
  QOSLivelinessLostCallbackType liveliness_callback;
  QOSOfferedIncompatibleQoSCallbackType incompatible_qos_callback;
  IncompatibleTypeCallbackType incompatible_type_callback;
  PublisherMatchedCallbackType matched_callback;
};

struct SubscriptionEventCallbacks {
  QOSDeadlineRequestedCallbackType deadline_callback;
  QOSLivelinessChangedCallbackType liveliness_callback;
  QOSRequestedIncompatibleQoSCallbackType incompatible_qos_callback;
  QOSMessageLostCallbackType message_lost_callback;
  IncompatibleTypeCallbackType incompatible_type_callback;
  SubscriptionMatchedCallbackType matched_callback;
};

class UnsupportedEventTypeException : public exceptions::RCLErrorBase, public std::runtime_error {
 public:
  UnsupportedEventTypeException(rcl_ret_t ret, const rcl_error_state_t* error_state, const std::string& prefix);
};

// Executors wait for the rcl event and run the callback in the group of the publisher or subscription.
class EventHandlerBase : public Waitable {
 public:
  enum class EntityType { Event };

  ~EventHandlerBase() override;

  size_t get_number_of_ready_events() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override;
  bool is_ready(const rcl_wait_set_t& wait_set) override;

  // `callback` gets the number of events, including one that came before, and EntityType::Event.
  void set_on_ready_callback(std::function<void(size_t, int)> callback) override;
  void clear_on_ready_callback() override;

  // The handle keeps the publisher or subscription alive.
  std::shared_ptr<const rcl_event_t> get_event_handle() const { return event_handle_; }

 protected:
  // `init` gets the rcl event to initialise. The event keeps `parent` alive. Throws UnsupportedEventTypeException or
  // exceptions::RCLError.
  EventHandlerBase(std::shared_ptr<const void> parent, const std::function<rcl_ret_t(rcl_event_t*)>& init);

  // Copies the status into `info`, which must be of this event's type. On failure logs a line and returns false.
  bool take_event(void* info);

 private:
  std::shared_ptr<rcl_event_t> event_handle_;
  size_t wait_set_event_index_ = 0;
  detail::OnReadyCallback on_ready_;
};

// `EventCallbackT` is a function that takes the status of its event, or a reference to it.
template <typename EventCallbackT, typename ParentHandleT>
class EventHandler : public EventHandlerBase {
 public:
  using EventCallbackInfoT =
      std::remove_reference_t<typename function_traits::function_traits<EventCallbackT>::template argument_type<0>>;

  // `init_func` is rcl_publisher_event_init or rcl_subscription_event_init.
  template <typename InitFuncT, typename EventTypeT>
  EventHandler(EventCallbackT callback, InitFuncT init_func, ParentHandleT parent_handle, EventTypeT event_type)
      : EventHandlerBase(parent_handle,
                         [&](rcl_event_t* event) { return init_func(event, parent_handle.get(), event_type); }),
        callback_(std::move(callback)) {}

  std::shared_ptr<void> take_data() override {
    auto info = std::make_shared<EventCallbackInfoT>();
    return take_event(info.get()) ? info : nullptr;
  }
  std::shared_ptr<void> take_data_by_entity_id(size_t) override { return take_data(); }

  void execute(const std::shared_ptr<void>& data) override {
    if (data) {
      callback_(*static_cast<EventCallbackInfoT*>(data.get()));
    }
  }

 private:
  EventCallbackT callback_;
};

using QOSEventHandlerBase = EventHandlerBase;
template <typename EventCallbackT, typename ParentHandleT>
using QOSEventHandler = EventHandler<EventCallbackT, ParentHandleT>;

}  // namespace rclcpp
