// SPDX-License-Identifier: Apache-2.0
// What an executor serves: the nodes and groups it was given, the entities in them, and the wait set.
//
// The list of entities is rebuilt only after something changed. It holds the rcl handles, so that a wait never looks at
// a dead one, and the rclcpp objects weakly, so that a user's reset() destroys a subscription at once. Its handle
// follows at once too if nobody waits, else as soon as the wait, which the change interrupts, has returned. Waitables
// are owned while they are waited for.
#pragma once

#include <rcl/wait.h>
#include <rcl/wait_restore.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/client_base.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"
#include "rclcpp/service_base.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

class ExecutorEntities : public std::enable_shared_from_this<ExecutorEntities> {
 public:
  using NodePtr = node_interfaces::NodeBaseInterface::SharedPtr;

  explicit ExecutorEntities(const Context::SharedPtr& context);
  ~ExecutorEntities();
  RCLCPP_DISABLE_COPY(ExecutorEntities)

  void add_node(const NodePtr& node);
  void remove_node(const NodePtr& node);
  void add_group(const CallbackGroup::SharedPtr& group, const NodePtr& node);
  void remove_group(const CallbackGroup::SharedPtr& group);
  void remove_all();

  enum class Origin { kAny, kAddedByHand, kOfNodes };
  std::vector<CallbackGroup::WeakPtr> groups(Origin origin);
  // The living entities of each group, in the order of groups().
  std::vector<std::pair<CallbackGroup::WeakPtr, CallbackGroup::Entities>> entities();

  // Waits until something is ready, interrupt() is called, or the time is over (negative: never). Appends what is
  // ready. Groups that cannot be taken from are left out: interrupt() when they can be again. One thread at a time.
  void wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready);

  // How often nodes and groups were removed. What an earlier wait found may be theirs.
  size_t removals() const { return removals_; }
  // Erases what is of no group that is served.
  void erase_unserved(std::vector<detail::ReadyEntity>& ready);

  // Ends the wait that is going on, or else the next one.
  void interrupt();

  // Is called, under a lock, after a change of nodes, groups or entities and by interrupt(): for executors that do not
  // wait() here. Empty: nothing.
  void set_on_change(std::function<void()> on_change);

 private:
  struct ServedGroup {
    CallbackGroup::WeakPtr group;
    node_interfaces::NodeBaseInterface::WeakPtr node;
    bool added_by_hand;
  };
  template <typename HandleT, typename EntityT>
  struct Waited {
    std::shared_ptr<HandleT> handle;
    std::weak_ptr<EntityT> entity;
  };
  // What is waited for of one group.
  struct WaitedGroup {
    CallbackGroup::WeakPtr group;
    std::shared_ptr<const std::atomic_bool> can_be_taken_from;
    std::vector<Waited<rcl_timer_t, TimerBase>> timers;
    std::vector<Waited<rcl_subscription_t, SubscriptionBase>> subscriptions;
    std::vector<Waited<rcl_service_t, ServiceBase>> services;
    std::vector<Waited<rcl_client_t, ClientBase>> clients;
    std::vector<Waited<const rcl_event_t, Waitable>> events;  // of event handlers, which need no care of their own
    std::vector<Waitable::WeakPtr> waitables;
    bool in_wait_set = false;
  };
  // How many entities of each kind the wait set has room for.
  struct Sizes {
    size_t timers = 0;
    size_t subscriptions = 0;
    size_t services = 0;
    size_t clients = 0;
    size_t events = 0;
    size_t guard_conditions = 0;
    bool operator==(const Sizes&) const = default;
  };
  struct HeldWaitable {
    Waitable::SharedPtr waitable;
    CallbackGroup::WeakPtr group;
  };
  // Owners that a locked section met on its way. They may be the last ones, and destructors report back here: the
  // caller lets go of them after the lock.
  struct Owners {
    std::vector<NodePtr> nodes;
    std::vector<CallbackGroup::SharedPtr> groups;
    std::vector<CallbackGroup::Entities> entities;
    std::vector<WaitedGroup> waited;
  };

  void changed();
  // With the mutex held:
  void mark_changed(Owners& owners);
  void find_groups(Owners& owners);
  void rebuild(Owners& owners);
  void serve(const CallbackGroup::SharedPtr& group, const NodePtr& node, bool added_by_hand);
  static void release(const CallbackGroup::SharedPtr& group);

  // Of the waiting thread:
  void fill_wait_set(std::vector<HeldWaitable>& waitables);
  void add_handles(const Sizes& sizes);
  void append_ready(const std::vector<HeldWaitable>& waitables, std::vector<detail::ReadyEntity>& ready) const;
  // The entities of one kind, group after group, of which the wait has left the handle.
  template <typename KindT>
  void append_left(const rcl_wait_set_left_indices_t& left, KindT WaitedGroup::*kind,
                   std::vector<detail::ReadyEntity>& ready) const;

  const std::shared_ptr<rcl_context_t> rcl_context_;
  GuardCondition interrupt_;
  rcl_wait_set_t wait_set_;

  std::atomic<size_t> removals_{0};
  std::mutex mutex_;
  std::vector<node_interfaces::NodeBaseInterface::WeakPtr> nodes_;
  std::vector<ServedGroup> groups_;
  std::function<void()> on_change_;
  bool changed_ = true;
  bool waiting_ = false;
  // While waiting_, of the waiting thread alone.
  std::vector<WaitedGroup> waited_;
  Sizes kept_sizes_;  // those with which the wait set keeps the handles of waited_; none: guard_conditions is 0
};

}  // namespace rclcpp
