// SPDX-License-Identifier: Apache-2.0
#include "executor/waited_entities.hpp"

#include <rcl/rmw_entity.hpp>
#include <utility>

#include "rclcpp/client_base.hpp"
#include "rclcpp/event_handler.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {

namespace {

template <typename EntityT, typename HandleT>
void add(std::vector<WaitedEntities::Entity>& entities, const std::shared_ptr<EntityT>& entity,
         std::shared_ptr<HandleT> handle, std::size_t group) {
  void* const rmw_entity = rcl::rmw_entity_of(handle.get());
  entities.push_back({std::weak_ptr(entity), std::move(handle), rmw_entity, group});
}

}  // namespace

WaitedEntities::WaitedEntities(std::vector<Group> served, const std::vector<CallbackGroup::Entities>& living)
    : groups(std::move(served)) {
  std::size_t count = 0;
  for (const CallbackGroup::Entities& of_group : living) {
    count +=
        of_group.subscriptions.size() + of_group.services.size() + of_group.clients.size() + of_group.waitables.size();
  }
  entities.reserve(count);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const TimerBase::SharedPtr& timer : living[group].timers) {
      add(timers, timer, timer->get_timer_handle(), group);
    }
    for (const SubscriptionBase::SharedPtr& subscription : living[group].subscriptions) {
      add(entities, subscription, subscription->get_subscription_handle(), group);
    }
  }
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const ServiceBase::SharedPtr& service : living[group].services) {
      add(entities, service, service->get_service_handle(), group);
    }
  }
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const ClientBase::SharedPtr& client : living[group].clients) {
      add(entities, client, client->get_client_handle(), group);
    }
  }
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (const Waitable::SharedPtr& waitable : living[group].waitables) {
      // At least one event handler stands for each publisher and subscription.
      if (const auto* handler = dynamic_cast<const EventHandlerBase*>(waitable.get())) {
        add(entities, waitable, handler->get_event_handle(), group);
      } else {
        waitables.push_back({waitable, group});
      }
    }
  }
}

}  // namespace rclcpp
