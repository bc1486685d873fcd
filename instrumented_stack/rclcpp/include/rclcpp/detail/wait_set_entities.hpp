// SPDX-License-Identifier: Apache-2.0
// The entities of a wait set, and the wait for them: the part that all kinds of wait sets share.
#pragma once

#include <rcl/wait.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#include "rclcpp/client_base.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/subscription_wait_set_mask.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/wait_result_kind.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp::detail {

// A waitable that is ready, or one whose is_ready() threw this exception.
struct ReadyWaitable {
  std::shared_ptr<Waitable> waitable;
  std::exception_ptr error;
};

// The entities that a wait has found ready. It owns them, so that they exist as long as the result.
struct WaitSetFindings {
  std::vector<std::shared_ptr<TimerBase>> timers;
  std::vector<std::shared_ptr<SubscriptionBase>> subscriptions;
  std::vector<std::shared_ptr<ServiceBase>> services;
  std::vector<std::shared_ptr<ClientBase>> clients;
  std::vector<ReadyWaitable> waitables;
};

// The class holds weak references to its entities.
//
// The functions that add and remove throw std::invalid_argument for null. Adding throws std::runtime_error if the
// entity is in any wait set already. Removing throws it if the entity is not in this one.
class WaitSetEntities {
 public:
  enum class Threads { kOne, kMany };

  // With kMany, other threads may call all functions during wait(). Their changes act on this wait at once.
  WaitSetEntities(const Context::SharedPtr& context, Threads threads);
  ~WaitSetEntities();
  RCLCPP_DISABLE_COPY(WaitSetEntities)

  void add_subscription(const std::shared_ptr<SubscriptionBase>& subscription, const SubscriptionWaitSetMask& mask);
  void remove_subscription(const std::shared_ptr<SubscriptionBase>& subscription, const SubscriptionWaitSetMask& mask);
  void add_guard_condition(const std::shared_ptr<GuardCondition>& guard_condition);
  void remove_guard_condition(const std::shared_ptr<GuardCondition>& guard_condition);
  void add_timer(const std::shared_ptr<TimerBase>& timer);
  void remove_timer(const std::shared_ptr<TimerBase>& timer);
  void add_client(const std::shared_ptr<ClientBase>& client);
  void remove_client(const std::shared_ptr<ClientBase>& client);
  void add_service(const std::shared_ptr<ServiceBase>& service);
  void remove_service(const std::shared_ptr<ServiceBase>& service);
  // If `associated_entity` is not null, the waitable leaves the wait set when that entity is destroyed.
  void add_waitable(const std::shared_ptr<Waitable>& waitable, const std::shared_ptr<void>& associated_entity);
  void remove_waitable(const std::shared_ptr<Waitable>& waitable);
  // Removes the entities that were destroyed. Each wait() does it, too.
  void prune_deleted_entities();

  // A negative time waits for ever. For one thread at a time.
  WaitResultKind wait(std::chrono::nanoseconds time_to_wait, WaitSetFindings& findings);

  // The state after the last wait: an entry that is not ready is null. The entities of each kind stand in the order in
  // which they were added.
  const rcl_wait_set_t& get_rcl_wait_set() const { return wait_set_; }

 private:
  template <typename EntityT>
  using List = std::vector<std::weak_ptr<EntityT>>;
  struct AssociatedWaitable {
    std::weak_ptr<Waitable> waitable;
    bool has_associated_entity;
    std::weak_ptr<void> associated_entity;
  };
  // Owns the entities during a wait.
  struct Owned {
    std::vector<std::shared_ptr<TimerBase>> timers;
    std::vector<std::shared_ptr<SubscriptionBase>> subscriptions;
    std::vector<std::shared_ptr<ServiceBase>> services;
    std::vector<std::shared_ptr<ClientBase>> clients;
    std::vector<std::shared_ptr<Waitable>> waitables;
    std::vector<std::shared_ptr<GuardCondition>> guard_conditions;
    std::vector<std::shared_ptr<void>> associated_entities;
  };

  template <typename EntityT>
  void add(List<EntityT>& list, const std::shared_ptr<EntityT>& entity, const char* kind);
  template <typename EntityT>
  void remove(List<EntityT>& list, const std::shared_ptr<EntityT>& entity, const char* kind);
  void changed();
  Owned own();
  void fill(const Owned& owned);
  void find_ready(const Owned& owned, WaitSetFindings& findings) const;

  const std::shared_ptr<rcl_context_t> rcl_context_;
  const std::unique_ptr<GuardCondition> interrupt_;  // null with Threads::kOne
  rcl_wait_set_t wait_set_;

  std::mutex mutex_;  // guards the following lists
  List<SubscriptionBase> subscriptions_;
  List<GuardCondition> guard_conditions_;
  List<TimerBase> timers_;
  List<ClientBase> clients_;
  List<ServiceBase> services_;
  std::vector<AssociatedWaitable> waitables_;
};

}  // namespace rclcpp::detail
