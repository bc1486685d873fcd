// Receives messages of one type from one topic. Created by Node::create_subscription().
#pragma once

#include <memory>
#include <rosidl_runtime_cpp/message_initialization.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <string>
#include <utility>

#include "rclcpp/subscription_base.hpp"

namespace rclcpp {

template <typename MessageT>
class Subscription : public SubscriptionBase {
 public:
  using ROSMessageType = MessageT;
  RCLCPP_SMART_PTR_DEFINITIONS(Subscription<MessageT>)

  Subscription(node_interfaces::NodeBaseInterface* node_base, const std::string& topic, const QoS& qos,
               AnySubscriptionCallback<MessageT> any_callback, const SubscriptionOptions& options)
      : SubscriptionBase(node_base, *rosidl_typesupport_cpp::get_message_type_support_handle<MessageT>(), topic, qos,
                         options),
        any_callback_(std::move(any_callback)) {
    trace_creation(any_callback_);
  }

  // The next message, without the callback. False if there is none.
  bool take(MessageT& message_out, MessageInfo& message_info_out) {
    return take_type_erased(&message_out, message_info_out);
  }

 protected:
  // Reading a message sets every member.
  std::shared_ptr<void> create_message() override {
    return std::make_shared<MessageT>(rosidl_runtime_cpp::MessageInitialization::SKIP);
  }
  AnySubscriptionCallbackBase& callback() override { return any_callback_; }

 private:
  AnySubscriptionCallback<MessageT> any_callback_;
};

}  // namespace rclcpp
