// SPDX-License-Identifier: Apache-2.0
// The nodes and callback groups that an executor serves, and their entities.
//
// The list of entities is rebuilt only after a change. When a user destroys an entity, the list releases the rcl handle
// at once if no thread waits. Otherwise the change interrupts the wait, and the handle is released after the wait. The
// list owns the waitables during a wait.
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
#include "rclcpp/node_interfaces/node_base_interface.hpp"

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
  // The entities of each group that exist now, in the order of groups().
  std::vector<std::pair<CallbackGroup::WeakPtr, CallbackGroup::Entities>> entities();

  // Waits until an entity is ready, interrupt() is called, or the timeout is over. A negative timeout never ends.
  // Appends the entities that are ready. Leaves out the groups of which nothing may be taken now: call interrupt() when
  // one of them may be taken from again. `ready_earlier` gets the waitables that former executors of groups left ready;
  // then the wait does not block. For one thread at a time.
  void wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready,
            std::vector<detail::ReadyEntity>& ready_earlier);

  // How often nodes and groups were removed. When the count changes, the findings of earlier waits may belong to
  // removed groups.
  size_t removals() const { return removals_; }
  // Erases the entities whose groups are not served any more. Leaves waitables to the next executor of their group.
  void erase_unserved(std::vector<detail::ReadyEntity>& ready);

  // Ends the wait that is going on. If there is none, the next wait ends at once.
  void interrupt();

  // For executors that execute beside the wait: calls enclose the moment in which a group may be taken from again. A
  // wait in which it falls may have left out some entities of the group and found others.
  void begin_giving_back() { ++begun_giving_back_; }
  void end_giving_back() { ++ended_giving_back_; }
  // How often it was ended; and whether it was begun since then, or is going on.
  size_t count_given_back() const { return ended_giving_back_; }
  bool is_given_back_since(size_t count) const { return begun_giving_back_ != count; }

  // For executors that do not call wait(). `on_change` is called under a lock: after each change of nodes, groups or
  // entities, and by interrupt(). An empty function ends the calls.
  void set_on_change(std::function<void()> on_change);

 private:
  struct ServedGroup {
    CallbackGroup::WeakPtr group;
    node_interfaces::NodeBaseInterface::WeakPtr node;
    bool added_by_hand;
  };
  // Owners that a locked section has acquired. They may be the last owners, and the destructors call this class. So the
  // caller releases them after the lock.
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
  void rebuild(Owners& owners, std::vector<detail::ReadyEntity>& ready_earlier);
  void serve(const CallbackGroup::SharedPtr& group, const NodePtr& node, bool added_by_hand);
  static void release(const CallbackGroup::SharedPtr& group);
  static void forget(node_interfaces::NodeBaseInterface& node);

  GuardCondition interrupt_;

  std::atomic<size_t> removals_{0};
  std::atomic<size_t> begun_giving_back_{0};
  std::atomic<size_t> ended_giving_back_{0};
  std::mutex mutex_;
  std::vector<node_interfaces::NodeBaseInterface::WeakPtr> nodes_;
  std::vector<ServedGroup> groups_;
  std::function<void()> on_change_;
  bool changed_ = true;
  bool waiting_ = false;
  ExecutorWait wait_;  // only the waiting thread may use it while `waiting_` is true
};

}  // namespace rclcpp
