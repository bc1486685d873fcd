// Subscriptions for anything that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/detail/qos_parameters.hpp"
#include "rclcpp/node_interfaces/get_node_interface.hpp"
#include "rclcpp/subscription.hpp"

namespace rclcpp {

// `node` is a Node, a pointer to one, or the like. Throws exceptions::InvalidTopicNameError,
// exceptions::InvalidQosOverridesException, exceptions::RCLError, and what the constructor of SubscriptionT throws.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename SubscriptionT = Subscription<MessageT, AllocatorT>, typename CallbackT, typename NodeT>
std::shared_ptr<SubscriptionT> create_subscription(
    NodeT&& node, const std::string& topic_name, const QoS& qos, CallbackT&& callback,
    const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>()) {
  const auto node_base = node_interfaces::dereferenced(node).get_node_base_interface();
  QoS actual_qos = qos;
  if (!options.qos_overriding_options.get_policy_kinds().empty()) {
    actual_qos = detail::declare_qos_parameters(
        options.qos_overriding_options, *node_interfaces::dereferenced(node).get_node_parameters_interface(),
        node_base->resolve_topic_or_service_name(topic_name, false), qos, detail::QosEntity::Subscription);
  }
  AnySubscriptionCallback<MessageT, AllocatorT> any_callback(*options.get_allocator());
  any_callback.set(std::forward<CallbackT>(callback));
  auto subscription =
      std::make_shared<SubscriptionT>(node_base.get(), topic_name, actual_qos, std::move(any_callback), options);
  node_interfaces::dereferenced(node).get_node_topics_interface()->add_subscription(subscription,
                                                                                    options.callback_group);
  return subscription;
}

}  // namespace rclcpp
