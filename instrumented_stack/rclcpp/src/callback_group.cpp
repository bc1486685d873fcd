#include "rclcpp/callback_group.hpp"

#include <algorithm>
#include <utility>

#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {

namespace {

// Adds and forgets the dead in the same go, so that the list stays as long as what lives.
template <typename EntityT>
void add(std::vector<std::weak_ptr<EntityT>>& entities, const std::shared_ptr<EntityT>& entity) {
  entities.erase(std::remove_if(entities.begin(), entities.end(), [](const auto& weak) { return weak.expired(); }),
                 entities.end());
  entities.push_back(entity);
}

template <typename EntityT>
void append_living(const std::vector<std::weak_ptr<EntityT>>& from, std::vector<std::shared_ptr<EntityT>>& to) {
  for (const std::weak_ptr<EntityT>& weak : from) {
    if (auto entity = weak.lock()) {
      to.push_back(std::move(entity));
    }
  }
}

}  // namespace

CallbackGroup::CallbackGroup(CallbackGroupType group_type, bool automatically_add_to_executor_with_node)
    : type_(group_type), automatically_add_to_executor_with_node_(automatically_add_to_executor_with_node) {}

void CallbackGroup::add_subscription(const std::shared_ptr<SubscriptionBase>& subscription) {
  subscription->set_callback_group(weak_from_this());
  {
    const std::lock_guard lock(mutex_);
    add(subscriptions_, subscription);
  }
  notify();
}

void CallbackGroup::add_timer(const std::shared_ptr<TimerBase>& timer) {
  timer->set_callback_group(weak_from_this());
  {
    const std::lock_guard lock(mutex_);
    add(timers_, timer);
  }
  notify();
}

void CallbackGroup::collect(Entities& entities) const {
  const std::lock_guard lock(mutex_);
  append_living(subscriptions_, entities.subscriptions);
  append_living(timers_, entities.timers);
}

size_t CallbackGroup::size() const {
  Entities entities;
  collect(entities);
  return entities.subscriptions.size() + entities.timers.size();
}

void CallbackGroup::set_on_change(std::function<void()> on_change) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(on_change);
}

void CallbackGroup::notify() const {
  std::function<void()> on_change;
  {
    const std::lock_guard lock(mutex_);
    on_change = on_change_;
  }
  if (on_change) {
    on_change();
  }
}

}  // namespace rclcpp
