// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/memory_strategy.hpp"

#include "rclcpp/memory_strategies.hpp"
#include "rclcpp/strategies/allocator_memory_strategy.hpp"

namespace rclcpp {

namespace memory_strategy {
namespace {

using Groups = MemoryStrategy::WeakCallbackGroupsToNodesMap;

// The first entity in the groups that `find` returns.
template <typename FindT>
auto first_in(const Groups& groups, FindT find) -> decltype(find(std::declval<const CallbackGroup&>())) {
  for (const auto& [weak_group, weak_node] : groups) {
    if (const CallbackGroup::SharedPtr group = weak_group.lock()) {
      if (auto found = find(*group)) {
        return found;
      }
    }
  }
  return nullptr;
}

// The first group, with a living node, that has what `has` looks for.
template <typename HasT>
CallbackGroup::SharedPtr group_with(const Groups& groups, HasT has) {
  for (const auto& [weak_group, weak_node] : groups) {
    const CallbackGroup::SharedPtr group = weak_group.lock();
    if (group && !weak_node.expired() && has(*group)) {
      return group;
    }
  }
  return nullptr;
}

}  // namespace

SubscriptionBase::SharedPtr MemoryStrategy::get_subscription_by_handle(
    const std::shared_ptr<const rcl_subscription_t>& subscriber_handle, const Groups& groups) {
  return first_in(groups, [&](const CallbackGroup& group) {
    return group.find_subscription_ptrs_if(
        [&](const auto& entity) { return entity->get_subscription_handle() == subscriber_handle; });
  });
}

ServiceBase::SharedPtr MemoryStrategy::get_service_by_handle(const std::shared_ptr<const rcl_service_t>& service_handle,
                                                             const Groups& groups) {
  return first_in(groups, [&](const CallbackGroup& group) {
    return group.find_service_ptrs_if(
        [&](const auto& entity) { return entity->get_service_handle() == service_handle; });
  });
}

ClientBase::SharedPtr MemoryStrategy::get_client_by_handle(const std::shared_ptr<const rcl_client_t>& client_handle,
                                                           const Groups& groups) {
  return first_in(groups, [&](const CallbackGroup& group) {
    return group.find_client_ptrs_if([&](const auto& entity) { return entity->get_client_handle() == client_handle; });
  });
}

TimerBase::SharedPtr MemoryStrategy::get_timer_by_handle(const std::shared_ptr<const rcl_timer_t>& timer_handle,
                                                         const Groups& groups) {
  return first_in(groups, [&](const CallbackGroup& group) {
    return group.find_timer_ptrs_if([&](const auto& entity) { return entity->get_timer_handle() == timer_handle; });
  });
}

node_interfaces::NodeBaseInterface::SharedPtr MemoryStrategy::get_node_by_group(const CallbackGroup::SharedPtr& group,
                                                                                const Groups& groups) {
  const auto found = group ? groups.find(group) : groups.end();
  return found == groups.end() ? nullptr : found->second.lock();
}

CallbackGroup::SharedPtr MemoryStrategy::get_group_by_subscription(const SubscriptionBase::SharedPtr& subscription,
                                                                   const Groups& groups) {
  return group_with(groups, [&](const CallbackGroup& group) {
    return group.find_subscription_ptrs_if([&](const auto& entity) { return entity == subscription; }) != nullptr;
  });
}

CallbackGroup::SharedPtr MemoryStrategy::get_group_by_service(const ServiceBase::SharedPtr& service,
                                                              const Groups& groups) {
  return group_with(groups, [&](const CallbackGroup& group) {
    return group.find_service_ptrs_if([&](const auto& entity) { return entity == service; }) != nullptr;
  });
}

CallbackGroup::SharedPtr MemoryStrategy::get_group_by_client(const ClientBase::SharedPtr& client,
                                                             const Groups& groups) {
  return group_with(groups, [&](const CallbackGroup& group) {
    return group.find_client_ptrs_if([&](const auto& entity) { return entity == client; }) != nullptr;
  });
}

CallbackGroup::SharedPtr MemoryStrategy::get_group_by_timer(const TimerBase::SharedPtr& timer, const Groups& groups) {
  return group_with(groups, [&](const CallbackGroup& group) {
    return group.find_timer_ptrs_if([&](const auto& entity) { return entity == timer; }) != nullptr;
  });
}

CallbackGroup::SharedPtr MemoryStrategy::get_group_by_waitable(const Waitable::SharedPtr& waitable,
                                                               const Groups& groups) {
  return group_with(groups, [&](const CallbackGroup& group) {
    return group.find_waitable_ptrs_if([&](const auto& entity) { return entity == waitable; }) != nullptr;
  });
}

}  // namespace memory_strategy

memory_strategy::MemoryStrategy::SharedPtr memory_strategies::create_default_strategy() {
  return std::make_shared<allocator_memory_strategy::AllocatorMemoryStrategy<>>();
}

}  // namespace rclcpp
