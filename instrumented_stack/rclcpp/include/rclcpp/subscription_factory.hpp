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

// The factory keeps a copy of the callback and the options. `statistics` may be null.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename SubscriptionT = Subscription<MessageT, AllocatorT>, typename CallbackT>
SubscriptionFactory create_subscription_factory(
    CallbackT&& callback, const SubscriptionOptionsWithAllocator<AllocatorT>& options,
    std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics = nullptr) {
  AnySubscriptionCallback<MessageT, AllocatorT> any_callback(*options.get_allocator());
  any_callback.set(std::forward<CallbackT>(callback));
  return {[options, any_callback = std::move(any_callback), statistics = std::move(statistics)](
              node_interfaces::NodeBaseInterface* node_base, const std::string& topic_name,
              const QoS& qos) -> SubscriptionBase::SharedPtr {
    auto subscription = std::make_shared<SubscriptionT>(node_base, topic_name, qos, any_callback, options);
    subscription->set_topic_statistics(statistics);
    return subscription;
  }};
}

}  // namespace rclcpp
