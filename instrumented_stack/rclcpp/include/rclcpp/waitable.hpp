// SPDX-License-Identifier: Apache-2.0
// A user's own object that an executor or a WaitSet can wait for. It adds rcl entities to the wait, tells from the
// result whether it is ready, and does its work.
//
// An executor makes these calls in this order: add_to_wait_set() before each wait, is_ready() after it, and then
// take_data() and execute() when it is this waitable's turn. The executor remembers readiness until then, so a
// triggered guard condition is not lost.
#pragma once

#include <rcl/wait.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "rclcpp/macros.hpp"

namespace rclcpp {

class TimerBase;

class Waitable {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(Waitable)

  Waitable() = default;
  virtual ~Waitable() = default;
  RCLCPP_DISABLE_COPY(Waitable)

  // The number of entities of each kind that add_to_wait_set() will add. They may change between waits.
  virtual size_t get_number_of_ready_subscriptions() { return 0; }
  virtual size_t get_number_of_ready_timers() { return 0; }
  virtual size_t get_number_of_ready_clients() { return 0; }
  virtual size_t get_number_of_ready_events() { return 0; }
  virtual size_t get_number_of_ready_services() { return 0; }
  virtual size_t get_number_of_ready_guard_conditions() { return 0; }

  virtual void add_to_wait_set(rcl_wait_set_t& wait_set) = 0;
  // `wait_set` is the state after the wait: entities that are not ready are null.
  virtual bool is_ready(const rcl_wait_set_t& wait_set) = 0;

  // Returns the data for execute(); null is allowed. The second is for executors that are notified which entity had an
  // event.
  virtual std::shared_ptr<void> take_data() = 0;
  virtual std::shared_ptr<void> take_data_by_entity_id(size_t id);
  virtual void execute(const std::shared_ptr<void>& data) = 0;

  // For executors that are notified of events instead of waiting. `callback` gets the number of events and the entity
  // that had them. It may be called from any thread, and must only take note. Throw std::runtime_error unless
  // overridden.
  virtual void set_on_ready_callback(std::function<void(size_t, int)> callback);
  virtual void clear_on_ready_callback();

  // Timers of this waitable, which an executor must also run.
  virtual std::vector<std::shared_ptr<TimerBase>> get_timers() const { return {}; }

  // Sets whether a wait set uses this waitable; returns the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

 private:
  friend class Executor;

  std::atomic_bool in_use_by_wait_set_{false};
  std::uint64_t passed_over_ = 0;  // of the executor
};

}  // namespace rclcpp
