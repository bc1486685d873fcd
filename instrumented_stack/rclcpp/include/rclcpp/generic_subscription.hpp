// SPDX-License-Identifier: Apache-2.0
// Receives messages as bytes; their type is known only by name, at run time. Created by
// Node::create_generic_subscription().
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/subscription_options.hpp"
#include "rclcpp/typesupport_helpers.hpp"

namespace rclcpp {

class GenericSubscription : public SubscriptionBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericSubscription)
  using CallbackType = AnySubscriptionCallback<SerializedMessage>;

  // `library` is the type support library of `topic_type`; see get_typesupport_library().
  template <typename AllocatorT = std::allocator<void>>
  GenericSubscription(
      node_interfaces::NodeBaseInterface* node_base, const std::shared_ptr<SharedLibrary>& library,
      const std::string& topic_name, const std::string& topic_type, const QoS& qos, CallbackType callback,
      const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>())
      : SubscriptionBase(node_base, *get_message_typesupport_handle(topic_type, "rosidl_typesupport_cpp", *library),
                         topic_name, qos, options),
        any_callback_(std::move(callback)) {
    trace_creation(any_callback_);
  }

  std::shared_ptr<void> create_message() override { return std::make_shared<SerializedMessage>(); }

 protected:
  AnySubscriptionCallbackBase& callback() override { return any_callback_; }

 private:
  CallbackType any_callback_;
};

}  // namespace rclcpp
