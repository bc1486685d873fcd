// SPDX-License-Identifier: Apache-2.0
// A group of entities (timers, subscriptions, services, clients, waitables) with common execution rules. Executors
// serve groups.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "rclcpp/macros.hpp"

namespace rclcpp {

class ClientBase;
class Context;
class GuardCondition;
class ServiceBase;
class SubscriptionBase;
class TimerBase;
class Waitable;

enum class CallbackGroupType {
  MutuallyExclusive,  // one callback at a time
  Reentrant,          // callbacks may run at the same time
};

// Holds its entities weakly: users own them. Thread safe.
class CallbackGroup : public std::enable_shared_from_this<CallbackGroup> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(CallbackGroup)

  // If a group is not added to the executor together with its node, add it with Executor::add_callback_group().
  explicit CallbackGroup(CallbackGroupType group_type, bool automatically_add_to_executor_with_node = true);
  // With get_notify_guard_condition().
  CallbackGroup(CallbackGroupType group_type, std::weak_ptr<Context> context,
                bool automatically_add_to_executor_with_node = true);
  ~CallbackGroup() { notify(); }

  CallbackGroupType type() const { return type_; }
  bool automatically_add_to_executor_with_node() const { return automatically_add_to_executor_with_node_; }
  // True while an executor has the group. Executors set it.
  std::atomic_bool& get_associated_with_executor_atomic() { return associated_with_executor_; }
  // False while a callback of a mutually exclusive group runs or is about to run. Executors set it.
  std::atomic_bool& can_be_taken_from() { return *can_be_taken_from_; }
  // Sets the flag after a callback, and tells the executor that got the group during the callback.
  void give_back();
  // The same flag, for code that may outlive the group.
  std::shared_ptr<const std::atomic_bool> shared_can_be_taken_from() const { return can_be_taken_from_; }

  void add_subscription(const std::shared_ptr<SubscriptionBase>& subscription);
  void add_timer(const std::shared_ptr<TimerBase>& timer);
  void add_service(const std::shared_ptr<ServiceBase>& service);
  void add_client(const std::shared_ptr<ClientBase>& client);
  void add_waitable(const std::shared_ptr<Waitable>& waitable);
  void remove_waitable(const std::shared_ptr<Waitable>& waitable) noexcept;

  struct Entities {
    std::vector<std::shared_ptr<SubscriptionBase>> subscriptions;
    std::vector<std::shared_ptr<TimerBase>> timers;
    std::vector<std::shared_ptr<ServiceBase>> services;
    std::vector<std::shared_ptr<ClientBase>> clients;
    std::vector<std::shared_ptr<Waitable>> waitables;
  };
  // Appends the living entities. Release them without a lock held, because these pointers may be the last owners.
  void collect(Entities& entities) const;
  size_t size() const;

  // The first living entity of the kind for which `function` returns true; else null.
  template <typename FunctionT>
  std::shared_ptr<SubscriptionBase> find_subscription_ptrs_if(FunctionT function) const {
    return find_if(living().subscriptions, function);
  }
  template <typename FunctionT>
  std::shared_ptr<TimerBase> find_timer_ptrs_if(FunctionT function) const {
    return find_if(living().timers, function);
  }
  template <typename FunctionT>
  std::shared_ptr<ServiceBase> find_service_ptrs_if(FunctionT function) const {
    return find_if(living().services, function);
  }
  template <typename FunctionT>
  std::shared_ptr<ClientBase> find_client_ptrs_if(FunctionT function) const {
    return find_if(living().clients, function);
  }
  template <typename FunctionT>
  std::shared_ptr<Waitable> find_waitable_ptrs_if(FunctionT function) const {
    return find_if(living().waitables, function);
  }

  // Calls the function for its kind with every living entity.
  void collect_all_ptrs(const std::function<void(const std::shared_ptr<SubscriptionBase>&)>& subscription_function,
                        const std::function<void(const std::shared_ptr<ServiceBase>&)>& service_function,
                        const std::function<void(const std::shared_ptr<ClientBase>&)>& client_function,
                        const std::function<void(const std::shared_ptr<TimerBase>&)>& timer_function,
                        const std::function<void(const std::shared_ptr<Waitable>&)>& waitable_function) const;

  // A waitable of the group that an executor found ready, and did not execute before the group left the executor. The
  // trigger is used up, so the next executor must execute the waitable without finding it ready.
  void leave_ready(const std::weak_ptr<Waitable>& waitable);
  // Hands over what was left.
  std::vector<std::weak_ptr<Waitable>> take_left_ready();

  // Sets the function that is called when an executor must look at the group again: after an entity was added or
  // destroyed, after leave_ready(), when the group is destroyed, and when the callback has ended that ran during
  // set_on_change(). Executors use it. It is called without a lock held.
  void set_on_change(std::function<void()> on_change);

  // Triggered by every change after its first call, for executors of others; null without a living context.
  std::shared_ptr<GuardCondition> get_notify_guard_condition();
  void trigger_notify_guard_condition() const;

  // Entities call it when they are destroyed.
  void entity_removed() const { notify(); }

 private:
  // Adds to one of the lists below.
  template <typename EntityT>
  void add(std::vector<std::weak_ptr<EntityT>> CallbackGroup::*list, const std::shared_ptr<EntityT>& entity);
  void notify() const;
  Entities living() const;
  template <typename EntityT, typename FunctionT>
  static std::shared_ptr<EntityT> find_if(const std::vector<std::shared_ptr<EntityT>>& entities, FunctionT function) {
    for (const std::shared_ptr<EntityT>& entity : entities) {
      if (function(entity)) {
        return entity;
      }
    }
    return nullptr;
  }

  const CallbackGroupType type_;
  const std::weak_ptr<Context> context_;
  const bool automatically_add_to_executor_with_node_;
  std::atomic_bool associated_with_executor_{false};
  const std::shared_ptr<std::atomic_bool> can_be_taken_from_ = std::make_shared<std::atomic_bool>(true);
  std::atomic_bool is_awaited_{false};  // by an executor that got the group while it could not be taken from

  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<SubscriptionBase>> subscriptions_;
  std::vector<std::weak_ptr<TimerBase>> timers_;
  std::vector<std::weak_ptr<ServiceBase>> services_;
  std::vector<std::weak_ptr<ClientBase>> clients_;
  std::vector<std::weak_ptr<Waitable>> waitables_;
  std::vector<std::weak_ptr<Waitable>> left_ready_;
  std::function<void()> on_change_;
  std::shared_ptr<GuardCondition> notify_guard_condition_;  // null until somebody asks for it
};

}  // namespace rclcpp
