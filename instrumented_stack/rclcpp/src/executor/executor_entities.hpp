// SPDX-License-Identifier: Apache-2.0
// What an executor serves: the nodes and groups that it was given, and the entities in them.
//
// The list of entities is rebuilt only after something has changed. When a user destroys an entity, the list lets go of
// the rcl handle at once if no thread waits. Otherwise the change interrupts the wait, and the handle goes as soon as
// the wait has returned. Waitables are owned while they are waited for.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "executor/executor_wait.hpp"
#include "executor/waited_entities.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"

namespace rclcpp {

class ExecutorEntities : public std::enable_shared_from_this<ExecutorEntities> {
 public:
  using NodePtr = node_interfaces::NodeBaseInterface::SharedPtr;

  explicit ExecutorEntities(const Context::SharedPtr& context);
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
  // Owners that a locked section met on its way. They may be the last ones, and destructors report back here: the
  // caller lets go of them after the lock.
  struct Owners {
    std::vector<NodePtr> nodes;
    std::vector<CallbackGroup::SharedPtr> groups;
    std::vector<CallbackGroup::Entities> entities;
    WaitedEntities waited;
  };

  void changed();
  // With the mutex held:
  void mark_changed(Owners& owners);
  void find_groups(Owners& owners);
  void rebuild(Owners& owners);
  void serve(const CallbackGroup::SharedPtr& group, const NodePtr& node, bool added_by_hand);
  static void release(const CallbackGroup::SharedPtr& group);

  GuardCondition interrupt_;

  std::atomic<size_t> removals_{0};
  std::mutex mutex_;
  std::vector<node_interfaces::NodeBaseInterface::WeakPtr> nodes_;
  std::vector<ServedGroup> groups_;
  std::function<void()> on_change_;
  bool changed_ = true;
  bool waiting_ = false;
  ExecutorWait wait_;  // while waiting_, of the waiting thread alone
};

}  // namespace rclcpp
