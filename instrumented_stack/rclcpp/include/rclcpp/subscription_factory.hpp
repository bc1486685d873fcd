// SPDX-License-Identifier: Apache-2.0
// Makes a subscription of a type that only the maker of the factory knows. NodeTopicsInterface::create_subscription()
// calls it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/subscription.hpp"
#include "rclcpp/subscription_options.hpp"

namespace rclcpp {

struct SubscriptionFactory {
  using SubscriptionFactoryFunction =
      std::function<SubscriptionBase::SharedPtr(node_interfaces::NodeBaseInterface*, const std::string&, const QoS&)>;

  SubscriptionFactoryFunction create_typed_subscription;
};

// The factory keeps a copy of the callback and the options. The memory strategy and `statistics` may be null.
template <typename MessageT, typename CallbackT, typename AllocatorT = std::allocator<void>,
          typename SubscriptionT = Subscription<MessageT, AllocatorT>,
          typename MessageMemoryStrategyT = typename SubscriptionT::MessageMemoryStrategyType>
SubscriptionFactory create_subscription_factory(
    CallbackT&& callback, const SubscriptionOptionsWithAllocator<AllocatorT>& options,
    typename MessageMemoryStrategyT::SharedPtr msg_mem_strat,
    std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics = nullptr) {
  AnySubscriptionCallback<MessageT, AllocatorT> any_callback(*options.get_allocator());
  any_callback.set(std::forward<CallbackT>(callback));
  return {[options, any_callback = std::move(any_callback), msg_mem_strat = std::move(msg_mem_strat),
           statistics = std::move(statistics)](node_interfaces::NodeBaseInterface* node_base,
                                               const std::string& topic_name,
                                               const QoS& qos) -> SubscriptionBase::SharedPtr {
    using Ros = typename TypeAdapter<MessageT>::ros_message_type;
    return std::make_shared<SubscriptionT>(node_base, *rosidl_typesupport_cpp::get_message_type_support_handle<Ros>(),
                                           topic_name, qos, any_callback, options, msg_mem_strat, statistics);
  }};
}

}  // namespace rclcpp
