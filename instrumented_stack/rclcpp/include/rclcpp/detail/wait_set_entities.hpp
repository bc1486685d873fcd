// SPDX-License-Identifier: Apache-2.0
// What a WaitSet waits for, and the waiting: the part that does not depend on the kind of wait set.
#pragma once

#include <rcl/wait.h>

#include <atomic>
#include <chrono>
#include <cstddef>
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

// What a wait found ready. It owns, so that it stays.
struct WaitSetFindings {
  std::vector<std::shared_ptr<TimerBase>> timers;
  std::vector<std::shared_ptr<SubscriptionBase>> subscriptions;
  std::vector<std::shared_ptr<ServiceBase>> services;
  std::vector<std::shared_ptr<ClientBase>> clients;
  std::vector<std::shared_ptr<Waitable>> waitables;
};

// Entities are referred to weakly. Functions add and remove throw std::invalid_argument for null and
// std::runtime_error for what a wait set has already, or this one does not have.
class WaitSetEntities {
 public:
  enum class Threads { kOne, kMany };

  // With kMany, everything may be called beside wait(), which takes note at once.
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
  // Waits no longer than `associated_entity`, if there is one, lives.
  void add_waitable(const std::shared_ptr<Waitable>& waitable, const std::shared_ptr<void>& associated_entity);
  void remove_waitable(const std::shared_ptr<Waitable>& waitable);
  // Forgets what was destroyed; each wait() does it too.
  void prune_deleted_entities();

  // Negative waits for ever. One thread at a time.
  WaitResultKind wait(std::chrono::nanoseconds time_to_wait, WaitSetFindings& findings);

  // As the last wait has left it, the entities of each kind in the order in which they were added.
  const rcl_wait_set_t& get_rcl_wait_set() const { return wait_set_; }

 private:
  template <typename EntityT>
  using List = std::vector<std::weak_ptr<EntityT>>;
  struct AssociatedWaitable {
    std::weak_ptr<Waitable> waitable;
    bool has_associated_entity;
    std::weak_ptr<void> associated_entity;
  };
  // The entities during a wait.
  struct Owned {
    WaitSetFindings entities;
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
  const std::unique_ptr<GuardCondition> interrupt_;  // for many threads
  rcl_wait_set_t wait_set_;

  std::mutex mutex_;  // of the lists
  List<SubscriptionBase> subscriptions_;
  List<GuardCondition> guard_conditions_;
  List<TimerBase> timers_;
  List<ClientBase> clients_;
  List<ServiceBase> services_;
  std::vector<AssociatedWaitable> waitables_;
};

}  // namespace rclcpp::detail
