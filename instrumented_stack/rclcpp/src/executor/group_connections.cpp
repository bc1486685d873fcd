// SPDX-License-Identifier: Apache-2.0
#include "executor/group_connections.hpp"

#include <algorithm>
#include <exception>
#include <type_traits>
#include <variant>

#include "executor/executor_entities.hpp"

namespace rclcpp {

namespace {

using Entity = GroupQueues::Entity;

// The middleware may call these while the entity or the executor ends; so they own the queues.
void start(SubscriptionBase& subscription, const std::shared_ptr<GroupQueues>& queues,
           const std::shared_ptr<Entity>& entity) {
  subscription.set_on_new_message_callback([queues, entity](std::size_t count) { queues->add(entity, count); });
}
void start(ServiceBase& service, const std::shared_ptr<GroupQueues>& queues, const std::shared_ptr<Entity>& entity) {
  service.set_on_new_request_callback([queues, entity](std::size_t count) { queues->add(entity, count); });
}
void start(ClientBase& client, const std::shared_ptr<GroupQueues>& queues, const std::shared_ptr<Entity>& entity) {
  client.set_on_new_response_callback([queues, entity](std::size_t count) { queues->add(entity, count); });
}
void start(Waitable& waitable, const std::shared_ptr<GroupQueues>& queues, const std::shared_ptr<Entity>& entity) {
  waitable.set_on_ready_callback([queues, entity](std::size_t count, int event) { queues->add(entity, count, event); });
}
void start(TimerBase& timer, const std::shared_ptr<GroupQueues>& queues, const std::shared_ptr<Entity>& entity) {
  entity->timer = timer.get_timer_handle();
  timer.set_on_reset_callback([queues](std::size_t) { queues->timers_changed(); });
}

void stop(SubscriptionBase& subscription) {
  subscription.clear_on_new_message_callback();
}
void stop(ServiceBase& service) {
  service.clear_on_new_request_callback();
}
void stop(ClientBase& client) {
  client.clear_on_new_response_callback();
}
void stop(Waitable& waitable) {
  waitable.clear_on_ready_callback();
}
void stop(TimerBase& timer) {
  timer.clear_on_reset_callback();
}

bool has_ended(const Entity& entity) {
  return std::visit([](const auto& weak) { return weak.expired(); }, entity.entity);
}

}  // namespace

void GroupConnections::update() {
  std::vector<std::pair<CallbackGroup::WeakPtr, CallbackGroup::Entities>> served;  // released without the lock
  Gone gone;
  std::exception_ptr failure;
  const std::lock_guard lock(mutex_);
  served = entities_.entities();
  ++updates_;
  for (const auto& [weak, entities] : served) {
    std::shared_ptr<Group>& group = groups_[weak];
    if (!group) {
      const CallbackGroup::SharedPtr living = weak.lock();
      if (!living) {
        groups_.erase(weak);
        continue;
      }
      group = std::make_shared<Group>(living);
    }
    connect_group(group, entities, gone, failure);
  }
  erase([this](const Connected& connected) { return connected.seen != updates_; }, gone);
  std::erase_if(groups_, [this](const auto& known) {
    if (known.first.expired()) {
      queues_->remove(*known.second);
      return true;
    }
    return false;
  });
  forget(gone);
  queues_->look_again();
  if (failure) {
    std::rethrow_exception(failure);
  }
}

void GroupConnections::disconnect_unserved() {
  std::vector<CallbackGroup::WeakPtr> served;
  Gone gone;
  const std::lock_guard lock(mutex_);
  served = entities_.groups(ExecutorEntities::Origin::kAny);
  std::erase_if(groups_, [&](const auto& known) {
    if (std::any_of(served.begin(), served.end(), [&](const CallbackGroup::WeakPtr& weak) {
          return !weak.owner_before(known.first) && !known.first.owner_before(weak);
        })) {
      return false;
    }
    queues_->remove(*known.second);
    return true;
  });
  erase([](const Connected& connected) { return connected.entity->group->is_removed; }, gone);
  forget(gone);
}

void GroupConnections::connect_group(const std::shared_ptr<Group>& group, const CallbackGroup::Entities& entities,
                                     Gone& gone, std::exception_ptr& failure) {
  const auto connect_all = [&](const auto& list) {
    for (const auto& entity : list) {
      try {
        connect(group, entity, gone);
      } catch (...) {
        failure = failure ? failure : std::current_exception();
      }
    }
  };
  connect_all(entities.subscriptions);
  connect_all(entities.services);
  connect_all(entities.clients);
  connect_all(entities.waitables);
  connect_all(entities.timers);
  for (const Waitable::SharedPtr& waitable : entities.waitables) {
    connect_all(waitable->get_timers());
  }
}

template <typename EntityT>
void GroupConnections::connect(const std::shared_ptr<Group>& group, const std::shared_ptr<EntityT>& entity,
                               Gone& gone) {
  const detail::AnyEntity weak = std::weak_ptr<EntityT>(entity);
  Connected& connected = connected_[{entity.get(), weak.index()}];
  // Another entity can be where one was that has gone.
  if (connected.entity && (has_ended(*connected.entity) || connected.entity->group != group)) {
    gone.push_back(std::move(connected.entity));
  }
  if (!connected.entity) {
    auto added = std::make_shared<Entity>(weak, group);
    try {
      start(*entity, queues_, added);
    } catch (...) {
      connected_.erase({entity.get(), weak.index()});
      throw;
    }
    connected.entity = std::move(added);
    have_timers_changed_ |= std::is_same_v<EntityT, TimerBase>;
  }
  connected.seen = updates_;
}

template <typename PredicateT>
void GroupConnections::erase(PredicateT is_gone, Gone& gone) {
  const detail::OnReadyCallback::HandBack hand_back;
  for (auto it = connected_.begin(); it != connected_.end();) {
    if (!is_gone(it->second)) {
      ++it;
      continue;
    }
    std::visit(
        [](const auto& weak) {
          if (const auto living = weak.lock()) {
            stop(*living);
          }
        },
        it->second.entity->entity);
    gone.push_back(std::move(it->second.entity));
    it = connected_.erase(it);
  }
}

void GroupConnections::forget(Gone& gone) {
  queues_->remove(gone);
  have_timers_changed_ |=
      std::any_of(gone.begin(), gone.end(), [](const auto& entity) { return entity->timer != nullptr; });
  if (!std::exchange(have_timers_changed_, false)) {
    return;
  }
  std::vector<std::shared_ptr<Entity>> timers;
  for (const auto& [key, connected] : connected_) {
    if (connected.entity->timer) {
      timers.push_back(connected.entity);
    }
  }
  queues_->set_timers(std::move(timers));
}

}  // namespace rclcpp
