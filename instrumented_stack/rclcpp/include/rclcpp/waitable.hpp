// Something of your own that an executor waits for and executes: made of guard conditions, timers and so on, which it
// puts into the executor's wait set. Give it to a node by NodeWaitables::add_waitable().
#pragma once

#include <rcl/wait.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

#include "rclcpp/macros.hpp"

namespace rclcpp {

class Waitable {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Waitable)

  Waitable() = default;
  virtual ~Waitable() = default;

  // How many of each add_to_wait_set() adds. They must not change while an executor has the waitable.
  virtual size_t get_number_of_ready_subscriptions() { return 0; }
  virtual size_t get_number_of_ready_timers() { return 0; }
  virtual size_t get_number_of_ready_clients() { return 0; }
  virtual size_t get_number_of_ready_events() { return 0; }
  virtual size_t get_number_of_ready_services() { return 0; }
  virtual size_t get_number_of_ready_guard_conditions() { return 0; }

  // Before each wait.
  virtual void add_to_wait_set(rcl_wait_set_t& wait_set) = 0;

  // After each wait, whose result is in the wait set that add_to_wait_set() got.
  virtual bool is_ready(const rcl_wait_set_t& wait_set) = 0;

  // What execute() is to work on, null for nothing. Under the executor's protection against another thread that takes
  // the same data.
  virtual std::shared_ptr<void> take_data() = 0;
  // The same for one of the things that a callback of set_on_ready_callback() names.
  virtual std::shared_ptr<void> take_data_by_entity_id(size_t id);

  virtual void execute(const std::shared_ptr<void>& data) = 0;

  // Marks the waitable as being in a wait set, or not; returns what it was.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

  // For executors that do not wait on a wait set: what happens when something becomes ready, with how many of it and
  // the identifier of the thing. From any thread. Throw std::runtime_error unless overridden.
  virtual void set_on_ready_callback(std::function<void(size_t, int)> callback);
  virtual void clear_on_ready_callback();

 private:
  std::atomic_bool in_use_by_wait_set_{false};
};

}  // namespace rclcpp
