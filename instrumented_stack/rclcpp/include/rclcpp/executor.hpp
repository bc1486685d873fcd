// SPDX-License-Identifier: Apache-2.0
// Waits for the entities of nodes and runs their callbacks. Concrete executors are in executors/.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <vector>

#include "rclcpp/any_executable.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/executor_options.hpp"
#include "rclcpp/future_return_code.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

class Node;
class ExecutorEntities;

// Holds nodes and groups weakly. Only one thread at a time may be in a spin function; a second one gets
// std::runtime_error. Everything else is thread safe.
class Executor {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(Executor)
  using NodePtr = node_interfaces::NodeBaseInterface::SharedPtr;

  explicit Executor(const ExecutorOptions& options = ExecutorOptions());
  virtual ~Executor();
  RCLCPP_DISABLE_COPY(Executor)

  // Adds the node's callback groups, present and future ones, except those made to be added one by one. Throws
  // std::runtime_error if an executor has the node already. A waiting executor takes note at once; `notify` only
  // belongs to rclcpp's interface.
  virtual void add_node(const NodePtr& node, bool notify = true);
  virtual void add_node(const std::shared_ptr<Node>& node, bool notify = true);
  // Throws std::runtime_error if this executor does not have the node.
  virtual void remove_node(const NodePtr& node, bool notify = true);
  virtual void remove_node(const std::shared_ptr<Node>& node, bool notify = true);

  // Adds one group. If its node was added, call remove_callback_group() first. Throw like the functions for nodes.
  virtual void add_callback_group(const CallbackGroup::SharedPtr& group, const NodePtr& node, bool notify = true);
  virtual void remove_callback_group(const CallbackGroup::SharedPtr& group, bool notify = true);
  virtual std::vector<CallbackGroup::WeakPtr> get_all_callback_groups();
  // The groups added by add_callback_group().
  virtual std::vector<CallbackGroup::WeakPtr> get_manually_added_callback_groups();
  // The groups added with nodes.
  virtual std::vector<CallbackGroup::WeakPtr> get_automatically_added_callback_groups_from_nodes();

  // Runs callbacks until shutdown or cancel().
  virtual void spin() = 0;

  // Runs at most one callback. Waits for it up to `timeout`; a negative timeout waits forever.
  virtual void spin_once(std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));

  // Runs the callbacks that are ready now, without waiting. Starts none after `max_duration` (0: no limit).
  virtual void spin_some(std::chrono::nanoseconds max_duration = std::chrono::nanoseconds(0));

  // Like spin_some(), and repeats with the callbacks that became ready meanwhile, until none is ready.
  virtual void spin_all(std::chrono::nanoseconds max_duration);

  // The node is added for the duration of the call.
  void spin_node_some(const NodePtr& node);
  void spin_node_some(const std::shared_ptr<Node>& node);
  template <typename RepT = int64_t, typename RatioT = std::milli>
  void spin_node_once(const NodePtr& node,
                      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    spin_node_once_nanoseconds(node, std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }
  template <typename NodeT = Node, typename RepT = int64_t, typename RatioT = std::milli>
  void spin_node_once(const std::shared_ptr<NodeT>& node,
                      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    spin_node_once_nanoseconds(node->get_node_base_interface(),
                               std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }
  void spin_node_all(const NodePtr& node, std::chrono::nanoseconds max_duration);
  void spin_node_all(const std::shared_ptr<Node>& node, std::chrono::nanoseconds max_duration);

  // Runs callbacks until the future has its value. A negative timeout waits forever.
  template <typename FutureT, typename RepT = int64_t, typename RatioT = std::milli>
  FutureReturnCode spin_until_future_complete(
      const FutureT& future, std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return spin_until([&future] { return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready; },
                      std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }

  // Makes the spin function return after the currently running callback. Does nothing if no spin function runs.
  virtual void cancel();
  bool is_spinning() const { return spinning_; }

 protected:
  class SpinningScope;

  void spin_node_once_nanoseconds(const NodePtr& node, std::chrono::nanoseconds timeout);
  // Called by spin_once(), spin_some() and spin_all() when the executor is marked as spinning.
  virtual void spin_once_impl(std::chrono::nanoseconds timeout);
  virtual void spin_some_impl(std::chrono::nanoseconds max_duration, bool exhaustive);

  // Gets the next entity to execute; waits for one if there is none. Returns false if the wait ended without one. Only
  // one thread at a time may call it or the two functions that it consists of.
  bool get_next_executable(AnyExecutable& any_executable,
                           std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  bool get_next_ready_executable(AnyExecutable& any_executable);
  void wait_for_work(std::chrono::nanoseconds timeout);
  // Executes it and releases its group, unless the spinning has been canceled. Any thread.
  void execute_any_executable(AnyExecutable& any_executable);
  // The same in any case.
  void execute_chosen(AnyExecutable& any_executable);
  // Ends the wait of the waiting thread; if there is none, the next wait.
  void interrupt();

  std::atomic_bool spinning_{false};
  Context::SharedPtr context_;
  const std::shared_ptr<ExecutorEntities> entities_;

 private:
  FutureReturnCode spin_until(const std::function<bool()>& complete, std::chrono::nanoseconds timeout);
  // Forgets what was found ready and is of no group that is served.
  void erase_unserved();
  // It was ready, but had to leave its turn to another one.
  void pass_over(detail::ReadyEntity ready);
  // What was passed over goes first, in the order in which it was passed over.
  void put_in_order();
  template <typename EntityT>
  bool choose_living(const std::shared_ptr<EntityT>& entity, AnyExecutable& any_executable);
  template <typename EntityT>
  static std::uint64_t& passed_over(EntityT& entity) {
    return entity.passed_over_;
  }

  // The entities that the last wait found. The first next_ready_ of them are used up. This costs O(1) per callback for
  // any number of entities, and no allocation once it has grown.
  std::vector<detail::ReadyEntity> ready_;
  size_t next_ready_ = 0;
  // Waitables that were passed over, or found ready by the former executor of their group. Other entities will be found
  // ready again, and have the number of their passing over.
  std::vector<detail::ReadyEntity> postponed_;
  std::uint64_t last_passed_over_ = 0;
  std::size_t count_passed_over_ = 0;  // and not chosen since
  size_t removals_seen_ = 0;           // removals of nodes and groups; later ones make ready_ stale
  OnShutdownCallbackHandle shutdown_callback_;
};

// Marks an executor as spinning while this lives. Throws std::runtime_error if the executor already spins.
class Executor::SpinningScope {
 public:
  SpinningScope(Executor& executor, const char* function);
  ~SpinningScope() { executor_.spinning_ = false; }
  RCLCPP_DISABLE_COPY(SpinningScope)

 private:
  Executor& executor_;
};

}  // namespace rclcpp
