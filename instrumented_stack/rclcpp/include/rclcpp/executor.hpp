// SPDX-License-Identifier: Apache-2.0
// Waits for the entities of nodes and runs their callbacks. Concrete executors are in executors/.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <vector>

#include "rclcpp/any_executable.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/ready_entity.hpp"
#include "rclcpp/executor_options.hpp"
#include "rclcpp/future_return_code.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base.hpp"

namespace rclcpp {

class Node;
class ExecutorEntities;

// Nodes and groups are kept weakly. Only one thread at a time may be in a spin function; a second one gets
// std::runtime_error. Everything else is thread safe.
class Executor {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(Executor)
  using NodePtr = node_interfaces::NodeBaseInterface::SharedPtr;

  explicit Executor(const ExecutorOptions& options = ExecutorOptions());
  virtual ~Executor();
  RCLCPP_DISABLE_COPY(Executor)

  // Adds the node's callback groups, present and future ones, unless they were made to be added one by one. Throws
  // std::runtime_error if an executor has the node already. Executors that wait take note at once; `notify` is of
  // rclcpp's interface.
  virtual void add_node(const NodePtr& node, bool notify = true);
  virtual void add_node(const std::shared_ptr<Node>& node, bool notify = true);
  // Throws std::runtime_error if this executor does not have the node.
  virtual void remove_node(const NodePtr& node, bool notify = true);
  virtual void remove_node(const std::shared_ptr<Node>& node, bool notify = true);

  // Adds one group; with the node only after remove_callback_group(). Throw like the functions for nodes.
  virtual void add_callback_group(const CallbackGroup::SharedPtr& group, const NodePtr& node, bool notify = true);
  virtual void remove_callback_group(const CallbackGroup::SharedPtr& group, bool notify = true);
  virtual std::vector<CallbackGroup::WeakPtr> get_all_callback_groups();
  // Those of add_callback_group().
  virtual std::vector<CallbackGroup::WeakPtr> get_manually_added_callback_groups();
  // Those of the nodes.
  virtual std::vector<CallbackGroup::WeakPtr> get_automatically_added_callback_groups_from_nodes();

  // Runs callbacks until shutdown or cancel().
  virtual void spin() = 0;

  // Runs at most one callback; waits for it up to `timeout`, negative for ever.
  virtual void spin_once(std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));

  // Runs what is ready now, without waiting, and begins no callback after `max_duration` (0: no limit).
  virtual void spin_some(std::chrono::nanoseconds max_duration = std::chrono::nanoseconds(0));

  // The same, and then what has become ready meanwhile, until nothing is ready.
  virtual void spin_all(std::chrono::nanoseconds max_duration);

  // Adds the node for the time of the call.
  void spin_node_some(const NodePtr& node);
  void spin_node_some(const std::shared_ptr<Node>& node);
  void spin_node_once(const NodePtr& node, std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  void spin_node_once(const std::shared_ptr<Node>& node,
                      std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  void spin_node_all(const NodePtr& node, std::chrono::nanoseconds max_duration);
  void spin_node_all(const std::shared_ptr<Node>& node, std::chrono::nanoseconds max_duration);

  // Runs callbacks until the future has its value. Negative waits for ever.
  template <typename FutureT, typename RepT = int64_t, typename RatioT = std::milli>
  FutureReturnCode spin_until_future_complete(
      const FutureT& future, std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return spin_until([&future] { return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready; },
                      std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }

  // Makes the spin function return after the callback that runs now. Without a spin function running, nothing happens.
  virtual void cancel();
  bool is_spinning() const { return spinning_; }

 protected:
  class SpinningScope;

  // What spin_once(), spin_some() and spin_all() do when the executor is marked as spinning.
  virtual void spin_once_impl(std::chrono::nanoseconds timeout);
  virtual void spin_some_impl(std::chrono::nanoseconds max_duration, bool exhaustive);

  // The next thing to execute; waits for one if there is none. False when the wait ended with nothing. It, and the two
  // it consists of, are for one thread at a time.
  bool get_next_executable(AnyExecutable& any_executable,
                           std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  bool get_next_ready_executable(AnyExecutable& any_executable);
  void wait_for_work(std::chrono::nanoseconds timeout);
  // Executes it and lets go of its group. Any thread.
  void execute_any_executable(AnyExecutable& any_executable);
  // Ends the wait of the thread that waits, or else the next wait.
  void interrupt();

  std::atomic_bool spinning_{false};
  Context::SharedPtr context_;
  const std::shared_ptr<ExecutorEntities> entities_;

 private:
  FutureReturnCode spin_until(const std::function<bool()>& complete, std::chrono::nanoseconds timeout);

  // What the last wait found, the first next_ready_ of it used up: O(1) per callback, however many entities there are,
  // and no allocation once it has grown.
  std::vector<detail::ReadyEntity> ready_;
  size_t next_ready_ = 0;
  // Waitables that were found ready while their group was busy. Other entities will be found again.
  std::vector<detail::ReadyEntity> postponed_;
  size_t removals_seen_ = 0;  // of nodes and groups; later ones make ready_ stale
  OnShutdownCallbackHandle shutdown_callback_;
};

// Marks an executor as spinning as long as it lives; throws std::runtime_error if it does so already.
class Executor::SpinningScope {
 public:
  SpinningScope(Executor& executor, const char* function);
  ~SpinningScope() { executor_.spinning_ = false; }
  RCLCPP_DISABLE_COPY(SpinningScope)

 private:
  Executor& executor_;
};

}  // namespace rclcpp
