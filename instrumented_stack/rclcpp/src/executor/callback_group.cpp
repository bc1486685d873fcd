// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/callback_group.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "rclcpp/client_base.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

namespace {

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
    : CallbackGroup(group_type, std::weak_ptr<Context>(), automatically_add_to_executor_with_node) {}

CallbackGroup::CallbackGroup(CallbackGroupType group_type, std::weak_ptr<Context> context,
                             bool automatically_add_to_executor_with_node)
    : type_(group_type),
      context_(std::move(context)),
      automatically_add_to_executor_with_node_(automatically_add_to_executor_with_node) {}

template <typename EntityT>
void CallbackGroup::add(std::vector<std::weak_ptr<EntityT>> CallbackGroup::*list,
                        const std::shared_ptr<EntityT>& entity) {
  if constexpr (!std::is_same_v<EntityT, Waitable>) {
    entity->set_callback_group(weak_from_this());
  }
  {
    const std::lock_guard lock(mutex_);
    auto& entities = this->*list;
    // Expired entries are removed here as well, so that the list is as long as the living entities are many.
    std::erase_if(entities, [](const auto& weak) { return weak.expired(); });
    entities.push_back(entity);
  }
  notify();
}

void CallbackGroup::add_subscription(const std::shared_ptr<SubscriptionBase>& subscription) {
  add(&CallbackGroup::subscriptions_, subscription);
}

void CallbackGroup::add_timer(const std::shared_ptr<TimerBase>& timer) {
  add(&CallbackGroup::timers_, timer);
}

void CallbackGroup::add_service(const std::shared_ptr<ServiceBase>& service) {
  add(&CallbackGroup::services_, service);
}

void CallbackGroup::add_client(const std::shared_ptr<ClientBase>& client) {
  add(&CallbackGroup::clients_, client);
}

void CallbackGroup::add_waitable(const std::shared_ptr<Waitable>& waitable) {
  add(&CallbackGroup::waitables_, waitable);
}

void CallbackGroup::remove_waitable(const std::shared_ptr<Waitable>& waitable) noexcept {
  {
    const std::lock_guard lock(mutex_);
    const auto is_removed = [&waitable](const std::weak_ptr<Waitable>& weak) {
      return !weak.owner_before(waitable) && !waitable.owner_before(weak);
    };
    std::erase_if(waitables_, is_removed);
    std::erase_if(left_ready_, is_removed);
  }
  notify();
}

void CallbackGroup::collect(Entities& entities) const {
  const std::lock_guard lock(mutex_);
  append_living(subscriptions_, entities.subscriptions);
  append_living(timers_, entities.timers);
  append_living(services_, entities.services);
  append_living(clients_, entities.clients);
  append_living(waitables_, entities.waitables);
}

CallbackGroup::Entities CallbackGroup::living() const {
  Entities entities;
  collect(entities);
  return entities;
}

size_t CallbackGroup::size() const {
  const Entities entities = living();
  return entities.subscriptions.size() + entities.timers.size() + entities.services.size() + entities.clients.size() +
         entities.waitables.size();
}

void CallbackGroup::collect_all_ptrs(
    const std::function<void(const std::shared_ptr<SubscriptionBase>&)>& subscription_function,
    const std::function<void(const std::shared_ptr<ServiceBase>&)>& service_function,
    const std::function<void(const std::shared_ptr<ClientBase>&)>& client_function,
    const std::function<void(const std::shared_ptr<TimerBase>&)>& timer_function,
    const std::function<void(const std::shared_ptr<Waitable>&)>& waitable_function) const {
  const Entities entities = living();
  std::for_each(entities.subscriptions.begin(), entities.subscriptions.end(), subscription_function);
  std::for_each(entities.services.begin(), entities.services.end(), service_function);
  std::for_each(entities.clients.begin(), entities.clients.end(), client_function);
  std::for_each(entities.timers.begin(), entities.timers.end(), timer_function);
  std::for_each(entities.waitables.begin(), entities.waitables.end(), waitable_function);
}

void CallbackGroup::set_on_change(std::function<void()> on_change) {
  {
    const std::lock_guard lock(mutex_);
    on_change_ = std::move(on_change);
  }
  if (!*can_be_taken_from_) {
    is_awaited_ = true;
  }
}

// Either this finds the group awaited, or the executor that got the group finds the flag set.
[[gnu::hot]] void CallbackGroup::give_back() {
  *can_be_taken_from_ = true;
  if (is_awaited_ && is_awaited_.exchange(false)) {
    notify();
  }
}

void CallbackGroup::leave_ready(const std::weak_ptr<Waitable>& waitable) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(left_ready_, [](const auto& weak) { return weak.expired(); });
    if (std::none_of(left_ready_.begin(), left_ready_.end(), [&waitable](const auto& weak) {
          return !weak.owner_before(waitable) && !waitable.owner_before(weak);
        })) {
      left_ready_.push_back(waitable);
    }
  }
  notify();
}

std::vector<std::weak_ptr<Waitable>> CallbackGroup::take_left_ready() {
  const std::lock_guard lock(mutex_);
  return std::exchange(left_ready_, {});
}

std::shared_ptr<GuardCondition> CallbackGroup::get_notify_guard_condition() {
  const std::lock_guard lock(mutex_);
  const std::shared_ptr<Context> context = context_.lock();
  if (!context || !context->is_valid()) {
    return nullptr;
  }
  if (!notify_guard_condition_) {
    notify_guard_condition_ = std::make_shared<GuardCondition>(context);
  }
  return notify_guard_condition_;
}

void CallbackGroup::trigger_notify_guard_condition() const {
  std::shared_ptr<GuardCondition> condition;
  {
    const std::lock_guard lock(mutex_);
    condition = notify_guard_condition_;
  }
  if (condition) {
    condition->trigger();
  }
}

void CallbackGroup::notify() const {
  std::function<void()> on_change;
  std::shared_ptr<GuardCondition> condition;
  {
    const std::lock_guard lock(mutex_);
    on_change = on_change_;
    condition = notify_guard_condition_;
  }
  if (on_change) {
    on_change();
  }
  if (condition) {
    try {
      condition->trigger();
    } catch (const exceptions::RCLError&) {
      // Entities end after the context, too.
    }
  }
}

}  // namespace rclcpp
