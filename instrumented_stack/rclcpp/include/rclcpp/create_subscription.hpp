// SPDX-License-Identifier: Apache-2.0
// Creates subscriptions for any object that has node interfaces.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/detail/qos_parameters.hpp"
#include "rclcpp/detail/topic_statistics.hpp"
#include "rclcpp/node_interfaces/get_node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/get_node_timers_interface.hpp"
#include "rclcpp/node_interfaces/get_node_topics_interface.hpp"
#include "rclcpp/subscription.hpp"

namespace rclcpp {

// `node_parameters` may be null if no policy can be overridden. Without a memory strategy, messages come from the
// allocator of the options. Without timers there are no statistics. Throws
// exceptions::InvalidTopicNameError, exceptions::InvalidQosOverridesException, exceptions::RCLError, and what the
// constructor of SubscriptionT throws.
template <typename MessageT, typename CallbackT, typename AllocatorT = std::allocator<void>,
          typename SubscriptionT = Subscription<MessageT, AllocatorT>,
          typename MessageMemoryStrategyT = typename SubscriptionT::MessageMemoryStrategyType>
std::shared_ptr<SubscriptionT> create_subscription(
    const std::shared_ptr<node_interfaces::NodeParametersInterface>& node_parameters,
    const std::shared_ptr<node_interfaces::NodeTopicsInterface>& node_topics, const std::string& topic_name,
    const QoS& qos, CallbackT&& callback,
    const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>(),
    typename MessageMemoryStrategyT::SharedPtr msg_mem_strat = nullptr,
    const std::shared_ptr<node_interfaces::NodeTimersInterface>& node_timers = nullptr) {
  auto& node_base = *node_topics->get_node_base_interface();
  const QoS actual_qos = detail::overridden_qos(options.qos_overriding_options, node_parameters, node_base, topic_name,
                                                qos, detail::QosEntity::Subscription);
  auto* timers = node_timers ? node_timers.get() : node_topics->get_node_timers_interface();
  auto statistics = timers ? detail::make_topic_statistics(options, node_base, *node_topics, *timers) : nullptr;
  const auto subscription = node_topics->create_subscription(
      topic_name,
      create_subscription_factory<MessageT, CallbackT, AllocatorT, SubscriptionT, MessageMemoryStrategyT>(
          std::forward<CallbackT>(callback), options, std::move(msg_mem_strat), std::move(statistics)),
      actual_qos);
  node_topics->add_subscription(subscription, options.callback_group);
  return std::dynamic_pointer_cast<SubscriptionT>(subscription);
}

// `node` is a Node, a pointer to one, a similar class, or only its topics interface. Throws std::invalid_argument for
// topic statistics whose period is not positive, and what the function above throws.
template <typename MessageT, typename CallbackT, typename AllocatorT = std::allocator<void>,
          typename SubscriptionT = Subscription<MessageT, AllocatorT>,
          typename MessageMemoryStrategyT = typename SubscriptionT::MessageMemoryStrategyType, typename NodeT>
std::shared_ptr<SubscriptionT> create_subscription(
    NodeT&& node, const std::string& topic_name, const QoS& qos, CallbackT&& callback,
    const SubscriptionOptionsWithAllocator<AllocatorT>& options = SubscriptionOptionsWithAllocator<AllocatorT>(),
    typename MessageMemoryStrategyT::SharedPtr msg_mem_strat = nullptr) {
  return create_subscription<MessageT, CallbackT, AllocatorT, SubscriptionT, MessageMemoryStrategyT>(
      node_interfaces::find_node_parameters_interface(node), node_interfaces::get_node_topics_interface(node),
      topic_name, qos, std::forward<CallbackT>(callback), options, std::move(msg_mem_strat),
      node_interfaces::find_node_timers_interface(node));
}

}  // namespace rclcpp
