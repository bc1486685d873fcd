// SPDX-License-Identifier: Apache-2.0
// An executor that does not wait for entities. The middleware notifies it of arrivals, and it keeps them in a queue. So
// the work per message does not depend on the number of entities.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rclcpp/executor.hpp"
#include "rclcpp/experimental/executors/events_executor/events_queue.hpp"
#include "rclcpp/experimental/executors/events_executor/simple_events_queue.hpp"
#include "rclcpp/experimental/timers_manager.hpp"
#include "rclcpp/node.hpp"

namespace rclcpp::experimental::executors {

// Callbacks run in the thread that calls spin(). With `execute_timers_separate_thread`, timers run in their own thread,
// at the same time as other callbacks of their group. As in rclcpp, the executor does not look whether a callback of a
// mutually exclusive group still runs in the executor that the group has left. Waitables must override
// set_on_ready_callback(). It fires no rclcpp_executor_* tracepoint of ros2, because they describe waiting. Those of
// ros2_ext record what it executes.
class EventsExecutor : public rclcpp::Executor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(EventsExecutor)

  explicit EventsExecutor(EventsQueue::UniquePtr events_queue = std::make_unique<SimpleEventsQueue>(),
                          bool execute_timers_separate_thread = false,
                          const rclcpp::ExecutorOptions& options = rclcpp::ExecutorOptions());
  ~EventsExecutor() override;

  void spin() override;

  // `max_duration` must be positive: 0, with which other executors have no limit, throws std::invalid_argument, as in
  // rclcpp.
  void spin_all(std::chrono::nanoseconds max_duration) override;

  // What leaves is disconnected from this executor when they return: the next executor may connect it then.
  using Executor::remove_node;
  void remove_node(const NodePtr& node, bool notify = true) override;
  void remove_callback_group(const CallbackGroup::SharedPtr& group, bool notify = true) override;

 protected:
  void spin_once_impl(std::chrono::nanoseconds timeout) override;
  void spin_some_impl(std::chrono::nanoseconds max_duration, bool exhaustive) override;

 private:
  template <typename EntityT>
  using Served = std::unordered_map<const void*, std::weak_ptr<EntityT>>;

  // Adds a wake-up to the queue. It makes the executor check its entities again.
  void wake();
  bool is_wake_up(const ExecutorEvent& event) const { return event.entity_key == this; }
  // Connects new entities to the queue and disconnects removed ones.
  void refresh();
  // Calls `remove`, and disconnects the entities of groups that are not served any more. Any thread.
  template <typename RemoveT>
  void remove_and_disconnect(RemoveT remove);
  template <typename EntityT, typename StartT, typename StopT>
  void update(Served<EntityT>& served, Served<EntityT> found, StartT start, StopT stop);
  void enqueue(const void* entity, ExecutorEventType type, size_t count, int waitable_data = 0);
  // Whose turn it was; kWakeUp is that of a wake-up.
  enum class Turn { kNone, kTimer, kEvent, kWakeUp };
  // Executes what is ready, or gets ready within the time. Timers that are due go first, once each; then each entity
  // has a turn before they go first again.
  Turn take_turn(std::chrono::nanoseconds timeout, bool of_timers, bool of_events);
  // Whether the entity of the event has had its turn since timers are due.
  bool has_had_turn(const ExecutorEvent& event) const;
  void execute_event(const ExecutorEvent& event);

  const EventsQueue::UniquePtr events_queue_;
  const bool execute_timers_separate_thread_;
  std::atomic_bool wake_up_queued_{false};
  TimersManager timers_;
  // Held while entities are connected or disconnected.
  std::mutex connections_mutex_;
  std::vector<const void*> disconnected_;  // since the last refresh(), of what is served below
  // Used only by the spinning thread.
  bool timers_thread_runs_ = false;
  size_t timers_left_ = 0;              // turns of timers that are due, before the next entity
  std::optional<ExecutorEvent> next_;   // out of the queue, and waits for them
  std::vector<const void*> had_turns_;  // since timers are due
  size_t removals_seen_ = 0;
  // Changed by the spinning thread with the mutex held.
  Served<SubscriptionBase> subscriptions_;
  Served<ServiceBase> services_;
  Served<ClientBase> clients_;
  Served<Waitable> waitables_;
  Served<TimerBase> timers_served_;
};

}  // namespace rclcpp::experimental::executors
