// SPDX-License-Identifier: Apache-2.0
// A source of time: the system's clock, a steady one, or ROS time, which a simulation may set.
#pragma once

#include <rcl/time.h>

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "rclcpp/context.hpp"
#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/duration.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/time.hpp"

namespace rclcpp {

// Functions that are called before and after jumps of a clock, while this object lives. See
// Clock::create_jump_callback().
class JumpHandler {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(JumpHandler)
  using pre_callback_t = std::function<void()>;
  using post_callback_t = std::function<void(const rcl_time_jump_t&)>;

  JumpHandler(pre_callback_t pre, post_callback_t post, const rcl_jump_threshold_t& threshold)
      : pre_callback(std::move(pre)), post_callback(std::move(post)), notice_threshold(threshold) {}

  pre_callback_t pre_callback;
  post_callback_t post_callback;
  rcl_jump_threshold_t notice_threshold;
};

// Copies share the underlying clock. All functions are thread safe.
class Clock {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Clock)

  explicit Clock(rcl_clock_type_t clock_type = RCL_SYSTEM_TIME);
  virtual ~Clock() = default;

  Time now() const;

  // Return true when the time was reached. Return false if the context ended first, if a simulation began or ceased to
  // drive the clock, or if the sleep was cancelled. While a simulation drives the clock, its time is slept. `until`
  // must be a time of this clock's type. Throw std::runtime_error without a valid context.
  bool sleep_until(Time until, Context::SharedPtr context = contexts::get_global_default_context());
  bool sleep_for(Duration duration, Context::SharedPtr context = contexts::get_global_default_context());

  // False while a simulation drives this clock and has not set a time yet.
  bool started() const;

  // Return true once the clock has started, false if the context or the time ended first. A clock that no simulation
  // drives has started. Throw std::runtime_error without a valid context.
  bool wait_until_started(Context::SharedPtr context = contexts::get_global_default_context());
  bool wait_until_started(const Duration& timeout, Context::SharedPtr context = contexts::get_global_default_context(),
                          const Duration& wait_tick_ns = Duration(0, 1'000'000));

  // Ends the sleep of one thread, now or when it next begins. Also ends the wait without a timeout.
  void cancel_sleep_or_wait();

  // Calls `pre_callback` before and `post_callback` after a jump that exceeds the threshold, in the thread that sets
  // the time. Either may be null. They must not use the clock. They are called while the returned object lives. Throws
  // exceptions::RCLError.
  [[nodiscard]] JumpHandler::SharedPtr create_jump_callback(JumpHandler::pre_callback_t pre_callback,
                                                            JumpHandler::post_callback_t post_callback,
                                                            const rcl_jump_threshold_t& threshold);

  // Whether a simulation drives this clock. Throws exceptions::RCLError unless it is a ROS time clock.
  bool ros_time_is_active() const;

  rcl_clock_type_t get_clock_type() const noexcept;
  rcl_clock_t* get_clock_handle() noexcept;
  std::mutex& get_clock_mutex() noexcept;

 private:
  friend class Rate;
  struct Impl;

  // As sleep_until(), but returns false if the context has ended already.
  bool sleep(const Time& until, const Context::SharedPtr& context);

  std::shared_ptr<Impl> impl_;
};

// Like a condition variable whose times are those of a clock. While a simulation drives the clock, its time counts.
class ClockWaiter {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(ClockWaiter)

  explicit ClockWaiter(const Clock::SharedPtr& clock);
  ~ClockWaiter();

  // Waits with `lock`'s mutex released until `pred` is true or the time is reached; also returns if a simulation begins
  // or ceases to drive the clock. Returns what `pred` returns then.
  bool wait_until(std::unique_lock<std::mutex>& lock, const Time& abs_time, const std::function<bool()>& pred);
  void notify_one();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The same with a mutex of its own; the end of the context ends the wait, too.
class ClockConditionalVariable {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(ClockConditionalVariable)

  // Throws std::runtime_error without a valid context.
  explicit ClockConditionalVariable(const Clock::SharedPtr& clock,
                                    Context::SharedPtr context = contexts::get_global_default_context());
  ~ClockConditionalVariable();

  // As in rclcpp, it always returns true; ask your predicate. Throws std::runtime_error if `lock` is not one of
  // mutex().
  bool wait_until(std::unique_lock<std::mutex>& lock, Time until, const std::function<bool()>& pred);
  void notify_one();
  std::mutex& mutex() { return mutex_; }

 private:
  std::mutex mutex_;
  bool shut_down_ = false;
  Context::SharedPtr context_;
  ClockWaiter waiter_;
  OnShutdownCallbackHandle shutdown_handle_;
};

}  // namespace rclcpp
