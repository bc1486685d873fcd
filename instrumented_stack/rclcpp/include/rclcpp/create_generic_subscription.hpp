// SPDX-License-Identifier: Apache-2.0
// Creates subscriptions whose type is given by name, for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/generic_subscription.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/typesupport_helpers.hpp"

namespace rclcpp {

// `topic_type` looks like "std_msgs/msg/String". The callback takes a SerializedMessage in one of the forms of
// any_subscription_callback.hpp. Throws std::runtime_error if the type cannot be found, and what create_subscription()
// throws.
template <typename CallbackT, typename AllocatorT = std::allocator<void>>
std::shared_ptr<GenericSubscription> create_generic_subscription(
    const node_interfaces::NodeTopicsInterface::SharedPtr& topics, const std::string& topic_name,
    const std::string& topic_type, const QoS& qos, CallbackT&& callback,
    const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>()) {
  GenericSubscription::CallbackType any_callback;
  any_callback.set(std::forward<CallbackT>(callback));
  auto subscription = std::make_shared<GenericSubscription>(
      topics->get_node_base_interface(), get_typesupport_library(topic_type, "rosidl_typesupport_cpp"), topic_name,
      topic_type, qos, std::move(any_callback), options);
  topics->add_subscription(subscription, options.callback_group);
  return subscription;
}

}  // namespace rclcpp
