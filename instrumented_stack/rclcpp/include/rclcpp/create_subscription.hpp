// Subscriptions for anything that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/subscription.hpp"

namespace rclcpp {

template <typename MessageT, typename CallbackT, typename NodeT>
typename Subscription<MessageT>::SharedPtr create_subscription(
    NodeT& node, const std::string& topic_name, const QoS& qos, CallbackT&& callback,
    const SubscriptionOptions& options = SubscriptionOptions()) {
  auto subscription = std::make_shared<Subscription<MessageT>>(
      node.get_node_base_interface().get(), topic_name, qos,
      AnySubscriptionCallback<MessageT>(std::forward<CallbackT>(callback)), options);
  node.get_node_topics_interface()->add_subscription(subscription, options.callback_group);
  return subscription;
}

}  // namespace rclcpp
