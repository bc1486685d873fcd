// What an executor waits for: the nodes and groups it was given, the entities in them, and the wait set.
//
// The list of entities is rebuilt only after something changed. It holds the rcl handles, so that a wait never looks at
// a dead one, and the rclcpp objects weakly, so that a user's reset() destroys a subscription at once. Its handle
// follows at once too if nobody waits, else as soon as the wait, which the change interrupts, has returned. Waitables
// have no handle apart from themselves: a wait holds them as long as it lasts.
#pragma once

#include <rcl/wait.h>

#include <atomic>
#include <chrono>
#include <cstddef>
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
  std::vector<CallbackGroup::WeakPtr> groups();

  // Waits until something is ready, interrupt() is called, or the time is over (negative: never). Appends what is
  // ready. One thread at a time.
  void wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready);

  // How often nodes and groups were removed. What an earlier wait found may be theirs.
  size_t removals() const { return removals_; }

  // Ends the wait that is going on, or else the next one.
  void interrupt() { interrupt_.trigger(); }

 private:
  struct ServedGroup {
    CallbackGroup::WeakPtr group;
    node_interfaces::NodeBaseInterface::WeakPtr node;
  };
  template <typename HandleT, typename EntityT>
  struct Waitable {
    std::shared_ptr<HandleT> handle;
    std::weak_ptr<EntityT> entity;
  };
  struct Waitables {
    std::vector<Waitable<rcl_timer_t, TimerBase>> timers;
    std::vector<Waitable<rcl_subscription_t, SubscriptionBase>> subscriptions;
    std::vector<Waitable<rcl_service_t, ServiceBase>> services;
    std::vector<Waitable<rcl_client_t, ClientBase>> clients;
    std::vector<rclcpp::Waitable::WeakPtr> others;
  };
  // Owners that a locked section met on its way. They may be the last ones, and destructors report back here: the
  // caller lets go of them after the lock.
  struct Owners {
    std::vector<NodePtr> nodes;
    std::vector<CallbackGroup::SharedPtr> groups;
    CallbackGroup::Entities entities;
    Waitables waitables;
  };

  void changed();
  // With the mutex held:
  void mark_changed(Owners& owners);
  void rebuild(Owners& owners);
  void serve(const CallbackGroup::SharedPtr& group, const NodePtr& node);
  static void release(const CallbackGroup::SharedPtr& group);

  void fill_wait_set();

  const std::shared_ptr<rcl_context_t> rcl_context_;
  GuardCondition interrupt_;
  rcl_wait_set_t wait_set_;

  std::atomic<size_t> removals_{0};
  std::mutex mutex_;
  std::vector<node_interfaces::NodeBaseInterface::WeakPtr> nodes_;
  std::vector<ServedGroup> groups_;
  bool changed_ = true;
  bool waiting_ = false;
  // While waiting_, of the waiting thread alone.
  Waitables waitables_;
  std::vector<rclcpp::Waitable::SharedPtr> held_;  // of waitables_.others, by a wait
};

}  // namespace rclcpp
