// SPDX-License-Identifier: Apache-2.0
// A memory strategy whose lists come from an allocator of the program.
#pragma once

#include <rcl/error_handling.h>
#include <rcl/wait.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/memory_strategy.hpp"
#include "rclcpp/node.hpp"

namespace rclcpp::memory_strategies::allocator_memory_strategy {

template <typename Alloc = std::allocator<void>>
class AllocatorMemoryStrategy : public memory_strategy::MemoryStrategy {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(AllocatorMemoryStrategy)
  using VoidAllocTraits = allocator::AllocRebind<void*, Alloc>;
  using VoidAlloc = typename VoidAllocTraits::allocator_type;

  AllocatorMemoryStrategy() : AllocatorMemoryStrategy(std::make_shared<Alloc>()) {}
  explicit AllocatorMemoryStrategy(const std::shared_ptr<Alloc>& allocator) : allocator_(*allocator) {}

  void add_guard_condition(const GuardCondition& guard_condition) override {
    if (std::find(guard_conditions_.begin(), guard_conditions_.end(), &guard_condition) == guard_conditions_.end()) {
      guard_conditions_.push_back(&guard_condition);
    }
  }
  void remove_guard_condition(const GuardCondition* guard_condition) override {
    const auto found = std::find(guard_conditions_.begin(), guard_conditions_.end(), guard_condition);
    if (found != guard_conditions_.end()) {
      guard_conditions_.erase(found);
    }
  }

  void clear_handles() override {
    subscriptions_.clear();
    services_.clear();
    clients_.clear();
    timers_.clear();
    waitables_.clear();
  }

  bool collect_entities(const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) override {
    bool some_are_gone = false;
    for (const auto& [weak_group, weak_node] : weak_groups_to_nodes) {
      const CallbackGroup::SharedPtr group = weak_group.lock();
      if (group == nullptr || weak_node.expired()) {
        some_are_gone = true;
      } else if (group->can_be_taken_from()) {
        collect(*group);
      }
    }
    return some_are_gone;
  }

  void add_waitable_handle(const Waitable::SharedPtr& waitable) override {
    if (waitable == nullptr) {
      throw std::runtime_error("waitable object unexpectedly nullptr");
    }
    waitables_.push_back(waitable);
  }

  bool add_handles_to_wait_set(rcl_wait_set_t* wait_set) override {
    const bool is_full = !add_all(wait_set, subscriptions_, rcl_wait_set_add_subscription, "subscription") ||
                         !add_all(wait_set, clients_, rcl_wait_set_add_client, "client") ||
                         !add_all(wait_set, services_, rcl_wait_set_add_service, "service") ||
                         !add_all(wait_set, timers_, rcl_wait_set_add_timer, "timer");
    if (is_full) {
      return false;
    }
    for (const GuardCondition* guard_condition : guard_conditions_) {
      const rcl_guard_condition_t* handle = &guard_condition->get_rcl_guard_condition();
      if (!added(rcl_wait_set_add_guard_condition(wait_set, handle, nullptr), "guard condition")) {
        return false;
      }
    }
    for (const Waitable::SharedPtr& waitable : waitables_) {
      waitable->add_to_wait_set(*wait_set);
    }
    return true;
  }

  // The entities of waitables stand behind the others.
  void remove_null_handles(rcl_wait_set_t* wait_set) override {
    keep_ready(subscriptions_, wait_set->subscriptions);
    keep_ready(services_, wait_set->services);
    keep_ready(clients_, wait_set->clients);
    keep_ready(timers_, wait_set->timers);
    const auto not_ready = [wait_set](const Waitable::SharedPtr& waitable) { return !waitable->is_ready(*wait_set); };
    waitables_.erase(std::remove_if(waitables_.begin(), waitables_.end(), not_ready), waitables_.end());
  }

  void get_next_subscription(AnyExecutable& any_exec,
                             const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) override {
    get_next(subscriptions_, get_subscription_by_handle, get_group_by_subscription, any_exec, weak_groups_to_nodes,
             [&any_exec](const SubscriptionBase::SharedPtr& entity) {
               any_exec.subscription = entity;
               return true;
             });
  }
  void get_next_service(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) override {
    get_next(services_, get_service_by_handle, get_group_by_service, any_exec, weak_groups_to_nodes,
             [&any_exec](const ServiceBase::SharedPtr& entity) {
               any_exec.service = entity;
               return true;
             });
  }
  void get_next_client(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) override {
    get_next(clients_, get_client_by_handle, get_group_by_client, any_exec, weak_groups_to_nodes,
             [&any_exec](const ClientBase::SharedPtr& entity) {
               any_exec.client = entity;
               return true;
             });
  }
  void get_next_timer(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) override {
    get_next(timers_, get_timer_by_handle, get_group_by_timer, any_exec, weak_groups_to_nodes,
             [&any_exec](const TimerBase::SharedPtr& entity) {
               auto data = entity->call();
               if (data == nullptr) {
                 return false;  // cancelled meanwhile
               }
               any_exec.timer = entity;
               any_exec.data = std::move(data);
               return true;
             });
  }
  void get_next_waitable(AnyExecutable& any_exec, const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes) override {
    const auto itself = [](const Waitable::SharedPtr& waitable, const WeakCallbackGroupsToNodesMap&) {
      return waitable;
    };
    get_next(waitables_, itself, get_group_by_waitable, any_exec, weak_groups_to_nodes,
             [&any_exec](const Waitable::SharedPtr& entity) {
               any_exec.waitable = entity;
               return true;
             });
  }

  rcl_allocator_t get_allocator() override { return allocator::get_rcl_allocator<void*, VoidAlloc>(allocator_); }

  size_t number_of_ready_subscriptions() const override {
    return subscriptions_.size() + in_waitables(&Waitable::get_number_of_ready_subscriptions);
  }
  size_t number_of_ready_services() const override {
    return services_.size() + in_waitables(&Waitable::get_number_of_ready_services);
  }
  size_t number_of_ready_clients() const override {
    return clients_.size() + in_waitables(&Waitable::get_number_of_ready_clients);
  }
  size_t number_of_ready_events() const override { return in_waitables(&Waitable::get_number_of_ready_events); }
  size_t number_of_ready_timers() const override {
    return timers_.size() + in_waitables(&Waitable::get_number_of_ready_timers);
  }
  size_t number_of_guard_conditions() const override {
    return guard_conditions_.size() + in_waitables(&Waitable::get_number_of_ready_guard_conditions);
  }
  size_t number_of_waitables() const override { return waitables_.size(); }

 private:
  template <typename T>
  using List = std::vector<T, allocator::Rebound<T, Alloc>>;
  template <typename T>
  using Handles = List<std::shared_ptr<const T>>;

  void collect(const CallbackGroup& group) {
    group.collect_all_ptrs(
        [this](const auto& subscription) { subscriptions_.push_back(subscription->get_subscription_handle()); },
        [this](const auto& service) { services_.push_back(service->get_service_handle()); },
        [this](const auto& client) { clients_.push_back(client->get_client_handle()); },
        [this](const auto& timer) { timers_.push_back(timer->get_timer_handle()); },
        [this](const auto& waitable) { waitables_.push_back(waitable); });
  }

  static bool added(rcl_ret_t result, const char* kind) {
    if (result == RCL_RET_OK) {
      return true;
    }
    RCLCPP_ERROR(get_logger("rclcpp"), "Couldn't add %s to wait set: %s", kind, rcl_get_error_string().str);
    rcl_reset_error();
    return false;
  }

  template <typename ListT, typename AddT>
  static bool add_all(rcl_wait_set_t* wait_set, const ListT& handles, AddT add, const char* kind) {
    return std::all_of(handles.begin(), handles.end(),
                       [&](const auto& handle) { return added(add(wait_set, handle.get(), nullptr), kind); });
  }

  // Entries of the wait set are in the order of the handles.
  template <typename ListT, typename EntryT>
  static void keep_ready(ListT& handles, const EntryT* entries) {
    size_t kept = 0;
    for (size_t i = 0; i < handles.size(); ++i) {
      if (entries[i] != nullptr) {
        handles[kept++] = std::move(handles[i]);
      }
    }
    handles.resize(kept);
  }

  // Takes the first handle whose entity lives and whose group is free, and for which `choose` returns true. Handles of
  // entities and groups that are gone are removed on the way.
  template <typename ListT, typename FindT, typename GroupOfT, typename ChooseT>
  static void get_next(ListT& handles, FindT find, GroupOfT group_of, AnyExecutable& any_exec,
                       const WeakCallbackGroupsToNodesMap& weak_groups_to_nodes, ChooseT choose) {
    for (auto it = handles.begin(); it != handles.end();) {
      const auto entity = find(*it, weak_groups_to_nodes);
      const CallbackGroup::SharedPtr group = entity ? group_of(entity, weak_groups_to_nodes) : nullptr;
      if (group == nullptr) {
        it = handles.erase(it);
      } else if (group->can_be_taken_from() && choose(entity)) {
        any_exec.callback_group = group;
        any_exec.node_base = get_node_by_group(group, weak_groups_to_nodes);
        handles.erase(it);
        return;
      } else {
        ++it;
      }
    }
  }

  size_t in_waitables(size_t (Waitable::*number)()) const {
    size_t sum = 0;
    for (const Waitable::SharedPtr& waitable : waitables_) {
      sum += (waitable.get()->*number)();
    }
    return sum;
  }

  VoidAlloc allocator_;
  List<const GuardCondition*> guard_conditions_{allocator_};
  Handles<rcl_subscription_t> subscriptions_{allocator_};
  Handles<rcl_service_t> services_{allocator_};
  Handles<rcl_client_t> clients_{allocator_};
  Handles<rcl_timer_t> timers_{allocator_};
  List<Waitable::SharedPtr> waitables_{allocator_};
};

}  // namespace rclcpp::memory_strategies::allocator_memory_strategy
