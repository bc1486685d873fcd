// SPDX-License-Identifier: Apache-2.0
// Waiting for messages, requests, responses, timers and conditions without an executor: the user decides what to take
// and when.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/detail/wait_set_entities.hpp"
#include "rclcpp/wait_result.hpp"

namespace rclcpp {

// A subscription, and the parts of it to wait for.
struct SubscriptionEntry {
  std::shared_ptr<SubscriptionBase> subscription;
  SubscriptionWaitSetMask mask;

  SubscriptionEntry(std::shared_ptr<SubscriptionBase> subscription_in = nullptr,  // NOLINT: lists of subscriptions
                    const SubscriptionWaitSetMask& mask_in = {})
      : subscription(std::move(subscription_in)), mask(mask_in) {}
  template <typename SubscriptionT, typename = std::enable_if_t<std::is_base_of_v<SubscriptionBase, SubscriptionT>>>
  SubscriptionEntry(std::shared_ptr<SubscriptionT> subscription_in,  // NOLINT: lists of subscriptions
                    const SubscriptionWaitSetMask& mask_in = {})
      : subscription(std::move(subscription_in)), mask(mask_in) {}
};

// A waitable, and the entity that it belongs to. The waitable leaves the wait set when that entity is destroyed.
struct WaitableEntry {
  std::shared_ptr<Waitable> waitable;
  std::shared_ptr<void> associated_entity;

  WaitableEntry(std::shared_ptr<Waitable> waitable_in = nullptr,  // NOLINT: lists of waitables
                std::shared_ptr<void> associated_entity_in = nullptr)
      : waitable(std::move(waitable_in)), associated_entity(std::move(associated_entity_in)) {}
};

namespace detail {

// The functions of all wait sets.
template <typename WaitSetT>
class WaitSetBase {
 public:
  using SubscriptionEntry = rclcpp::SubscriptionEntry;
  using WaitableEntry = rclcpp::WaitableEntry;

  // Waits until an entity is ready or the time is over. A negative time waits for ever. Throws exceptions::RCLError.
  template <typename RepT = int64_t, typename PeriodT = std::milli>
  WaitResult<WaitSetT> wait(
      std::chrono::duration<RepT, PeriodT> time_to_wait = std::chrono::duration<RepT, PeriodT>(-1)) {
    WaitSetFindings findings;
    const WaitResultKind kind =
        entities_.wait(std::chrono::duration_cast<std::chrono::nanoseconds>(time_to_wait), findings);
    return WaitResult<WaitSetT>(kind, static_cast<WaitSetT&>(*this), std::move(findings));
  }

  // The state after the last wait: an entry that is not ready is null. The entities of each kind stand in the order in
  // which they were added.
  const rcl_wait_set_t& get_rcl_wait_set() const { return entities_.get_rcl_wait_set(); }

 protected:
  WaitSetBase(const Context::SharedPtr& context, WaitSetEntities::Threads threads) : entities_(context, threads) {}
  ~WaitSetBase() = default;

  WaitSetEntities entities_;
};

// Wait sets whose entities may change. They hold weak references, and forget destroyed entities.
template <typename WaitSetT, WaitSetEntities::Threads kThreads>
class DynamicWaitSet : public WaitSetBase<WaitSetT> {
 public:
  explicit DynamicWaitSet(const std::vector<SubscriptionEntry>& subscriptions = {},
                          const std::vector<std::shared_ptr<GuardCondition>>& guard_conditions = {},
                          const std::vector<std::shared_ptr<TimerBase>>& timers = {},
                          const std::vector<std::shared_ptr<ClientBase>>& clients = {},
                          const std::vector<std::shared_ptr<ServiceBase>>& services = {},
                          const std::vector<WaitableEntry>& waitables = {},
                          const Context::SharedPtr& context = contexts::get_global_default_context())
      : WaitSetBase<WaitSetT>(context, kThreads) {
    for (const SubscriptionEntry& entry : subscriptions) {
      add_subscription(entry.subscription, entry.mask);
    }
    for (const auto& guard_condition : guard_conditions) {
      add_guard_condition(guard_condition);
    }
    for (const auto& timer : timers) {
      add_timer(timer);
    }
    for (const auto& client : clients) {
      add_client(client);
    }
    for (const auto& service : services) {
      add_service(service);
    }
    for (const WaitableEntry& entry : waitables) {
      add_waitable(entry.waitable, entry.associated_entity);
    }
  }

  // All of these throw std::invalid_argument for null. Adding throws std::runtime_error if the entity is in any wait
  // set already. Removing throws it if the entity is not in this one.
  void add_subscription(const std::shared_ptr<SubscriptionBase>& subscription,
                        const SubscriptionWaitSetMask& mask = {}) {
    this->entities_.add_subscription(subscription, mask);
  }
  void remove_subscription(const std::shared_ptr<SubscriptionBase>& subscription,
                           const SubscriptionWaitSetMask& mask = {}) {
    this->entities_.remove_subscription(subscription, mask);
  }
  void add_guard_condition(const std::shared_ptr<GuardCondition>& guard_condition) {
    this->entities_.add_guard_condition(guard_condition);
  }
  void remove_guard_condition(const std::shared_ptr<GuardCondition>& guard_condition) {
    this->entities_.remove_guard_condition(guard_condition);
  }
  void add_timer(const std::shared_ptr<TimerBase>& timer) { this->entities_.add_timer(timer); }
  void remove_timer(const std::shared_ptr<TimerBase>& timer) { this->entities_.remove_timer(timer); }
  void add_client(const std::shared_ptr<ClientBase>& client) { this->entities_.add_client(client); }
  void remove_client(const std::shared_ptr<ClientBase>& client) { this->entities_.remove_client(client); }
  void add_service(const std::shared_ptr<ServiceBase>& service) { this->entities_.add_service(service); }
  void remove_service(const std::shared_ptr<ServiceBase>& service) { this->entities_.remove_service(service); }
  void add_waitable(const std::shared_ptr<Waitable>& waitable,
                    const std::shared_ptr<void>& associated_entity = nullptr) {
    this->entities_.add_waitable(waitable, associated_entity);
  }
  void remove_waitable(const std::shared_ptr<Waitable>& waitable) { this->entities_.remove_waitable(waitable); }

  // Removes the entities that were destroyed. Each wait() does it, too.
  void prune_deleted_entities() { this->entities_.prune_deleted_entities(); }
};

}  // namespace detail

// For one thread.
class WaitSet final : public detail::DynamicWaitSet<WaitSet, detail::WaitSetEntities::Threads::kOne> {
 public:
  using DynamicWaitSet::DynamicWaitSet;
};

// Any thread may add and remove entities, also while another thread waits. The changes act on that wait at once.
class ThreadSafeWaitSet final
    : public detail::DynamicWaitSet<ThreadSafeWaitSet, detail::WaitSetEntities::Threads::kMany> {
 public:
  using DynamicWaitSet::DynamicWaitSet;
};

// A wait set whose entities are fixed. It owns them.
template <size_t kSubscriptions, size_t kGuardConditions, size_t kTimers, size_t kClients, size_t kServices,
          size_t kWaitables>
class StaticWaitSet final
    : public detail::WaitSetBase<
          StaticWaitSet<kSubscriptions, kGuardConditions, kTimers, kClients, kServices, kWaitables>> {
 public:
  using Subscriptions = std::array<SubscriptionEntry, kSubscriptions>;
  using GuardConditions = std::array<std::shared_ptr<GuardCondition>, kGuardConditions>;
  using Timers = std::array<std::shared_ptr<TimerBase>, kTimers>;
  using Clients = std::array<std::shared_ptr<ClientBase>, kClients>;
  using Services = std::array<std::shared_ptr<ServiceBase>, kServices>;
  using Waitables = std::array<WaitableEntry, kWaitables>;

  // Throws like the add functions of WaitSet.
  explicit StaticWaitSet(const Subscriptions& subscriptions = {}, const GuardConditions& guard_conditions = {},
                         const Timers& timers = {}, const Clients& clients = {}, const Services& services = {},
                         const Waitables& waitables = {},
                         const Context::SharedPtr& context = contexts::get_global_default_context())
      : detail::WaitSetBase<StaticWaitSet>(context, detail::WaitSetEntities::Threads::kOne),
        subscriptions_(subscriptions),
        guard_conditions_(guard_conditions),
        timers_(timers),
        clients_(clients),
        services_(services),
        waitables_(waitables) {
    for (const SubscriptionEntry& entry : subscriptions_) {
      this->entities_.add_subscription(entry.subscription, entry.mask);
    }
    for (const auto& guard_condition : guard_conditions_) {
      this->entities_.add_guard_condition(guard_condition);
    }
    for (const auto& timer : timers_) {
      this->entities_.add_timer(timer);
    }
    for (const auto& client : clients_) {
      this->entities_.add_client(client);
    }
    for (const auto& service : services_) {
      this->entities_.add_service(service);
    }
    for (const WaitableEntry& entry : waitables_) {
      this->entities_.add_waitable(entry.waitable, entry.associated_entity);
    }
  }

 private:
  const Subscriptions subscriptions_;
  const GuardConditions guard_conditions_;
  const Timers timers_;
  const Clients clients_;
  const Services services_;
  const Waitables waitables_;
};

}  // namespace rclcpp
