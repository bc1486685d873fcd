// SPDX-License-Identifier: Apache-2.0
// An executor with several threads that does not wait for entities: the middleware notifies it of arrivals, and it
// keeps a queue for each callback group. So the work per message does not depend on the number of entities.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>

#include "rclcpp/executor.hpp"

namespace rclcpp {

class GroupQueues;
class GroupConnections;

namespace executors {

// Callbacks of a reentrant group may run at the same time, those of a mutually exclusive group run one at a time. The
// entity that has been ready longest is next, of whatever kind; an entity with several messages goes behind the others
// after each. Timers of all clocks may be mixed. Waitables must override set_on_ready_callback() and
// take_data_by_entity_id().
class EventsCBGExecutor : public Executor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(EventsCBGExecutor)

  // `number_of_threads` includes the thread that calls spin(); 0: one per processor, at least 2. `timeout` limits each
  // wait for work; negative: no limit.
  explicit EventsCBGExecutor(const ExecutorOptions& options = ExecutorOptions(), size_t number_of_threads = 0,
                             std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  ~EventsCBGExecutor() override;

  // If a callback throws, all threads end, and spin() throws the first exception.
  void spin() override;
  // Calls `exception_handler` with each std::exception of a callback, in the thread of the callback. If the handler
  // throws, that is the exception of the callback.
  void spin(const std::function<void(const std::exception&)>& exception_handler);
  // Executes what is ready: that of the moment, or all until nothing is ready. Returns true if there was some.
  bool collect_and_execute_ready_events(std::chrono::nanoseconds max_duration, bool recollect_if_no_work_available);

  // Adds a group without telling its node.
  void add_callback_group_only(const CallbackGroup::SharedPtr& group);
  // What leaves is disconnected from this executor when they return: the next executor may connect it then.
  using Executor::remove_node;
  void remove_node(const NodePtr& node, bool notify = true) override;
  void remove_callback_group(const CallbackGroup::SharedPtr& group, bool notify = true) override;

  size_t get_number_of_threads() const { return number_of_threads_; }

 protected:
  void spin_once_impl(std::chrono::nanoseconds timeout) override;
  void spin_some_impl(std::chrono::nanoseconds max_duration, bool exhaustive) override;

 private:
  using ExceptionHandler = std::function<void(const std::exception&)>;

  bool execute_ready(std::chrono::nanoseconds max_duration, bool exhaustive);
  void connect_what_changed();
  void run();
  void run_and_keep_failure(const ExceptionHandler& exception_handler);

  const size_t number_of_threads_;
  const std::chrono::nanoseconds next_exec_timeout_;
  const std::shared_ptr<GroupQueues> queues_;
  const std::unique_ptr<GroupConnections> connections_;
  std::atomic_bool has_changed_{true};
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

}  // namespace executors

}  // namespace rclcpp
