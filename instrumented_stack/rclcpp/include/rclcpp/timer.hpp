// SPDX-License-Identifier: Apache-2.0
// Calls a function at equal intervals. Created by Node::create_wall_timer() and Node::create_timer().
#pragma once

#include <rcl/timer.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <type_traits>
#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/clock.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/callback_symbol.hpp"
#include "rclcpp/detail/on_ready_callback.hpp"
#include "rclcpp/function_traits.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/rate.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

class TimerBase;

using VoidCallbackType = std::function<void()>;
using TimerCallbackType = std::function<void(TimerBase&)>;

// The time at which a call of a timer was due and the time at which it was made, on the timer's clock.
struct TimerInfo {
  Time expected_call_time;
  Time actual_call_time;
};

class TimerBase {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(TimerBase)

  TimerBase(Clock::SharedPtr clock, std::chrono::nanoseconds period, Context::SharedPtr context, bool autostart);
  virtual ~TimerBase();
  RCLCPP_DISABLE_COPY(TimerBase)

  // A cancelled timer is not due until reset().
  void cancel();
  bool is_canceled();
  // The next call is one period from now.
  void reset();

  // Negative if overdue, the largest value for a cancelled timer.
  std::chrono::nanoseconds time_until_trigger();
  bool is_ready();
  // Whether the timer's clock is steady.
  bool is_steady() const { return clock_->get_clock_type() == RCL_STEADY_TIME; }
  Clock::SharedPtr get_clock() const { return clock_; }

  // Executors call these in this order. call() counts the call and sets the next one; it returns null if the timer was
  // cancelled meanwhile. Then execute_callback() runs the function with the result of call(). Without this result, a
  // function that takes a TimerInfo gets a call that is due now.
  std::shared_ptr<void> call();
  void execute_callback(const std::shared_ptr<void>& data);
  void execute_callback();

  std::shared_ptr<const rcl_timer_t> get_timer_handle() const { return timer_handle_; }
  std::shared_ptr<rcl_timer_t> get_timer_handle() { return timer_handle_; }

  // `callback` is called after every reset(), and after every jump of simulated time, by the thread that causes it.
  // Throws std::invalid_argument for an empty callback. Do not call either function from the callback.
  void set_on_reset_callback(std::function<void(size_t)> callback);
  void clear_on_reset_callback();
  // Sets whether a wait set uses this timer; returns the former state.
  bool exchange_in_use_by_wait_set_state(bool in_use_state) { return in_use_by_wait_set_.exchange(in_use_state); }

  // The group that serves this timer, set by the group.
  void set_callback_group(CallbackGroup::WeakPtr group) { callback_group_ = std::move(group); }

 protected:
  virtual void run(const TimerInfo& info) = 0;

  // Call it in the most derived constructor. `callback` is the final address of the function.
  void trace_callback(const void* callback, const detail::CallbackSymbol& symbol);

 private:
  friend class Executor;

  void execute(const TimerInfo& info);

  Clock::SharedPtr clock_;
  std::shared_ptr<rcl_timer_t> timer_handle_;
  const void* callback_ = nullptr;
  CallbackGroup::WeakPtr callback_group_;
  detail::OnReadyCallback on_ready_;
  std::atomic_bool in_use_by_wait_set_{false};
  std::uint64_t passed_over_ = 0;  // of the executor
};

// `FunctorT` can be called with nothing, with a TimerBase &, or with a const TimerInfo &.
template <typename FunctorT>
class GenericTimer : public TimerBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericTimer)

  GenericTimer(Clock::SharedPtr clock, std::chrono::nanoseconds period, FunctorT callback, Context::SharedPtr context,
               bool autostart = true)
      : TimerBase(std::move(clock), period, std::move(context), autostart), callback_(std::move(callback)) {
    trace_callback(&callback_, detail::CallbackSymbol::of(callback_));
  }

 protected:
  void run([[maybe_unused]] const TimerInfo& info) override {
    if constexpr (std::is_invocable_v<FunctorT&>) {
      callback_();
    } else if constexpr (std::is_invocable_v<FunctorT&, TimerBase&>) {
      callback_(*this);
    } else {
      static_assert(std::is_invocable_v<FunctorT&, const TimerInfo&>,
                    "a timer callback takes nothing, a TimerBase & or a const TimerInfo &");
      callback_(info);
    }
  }

 private:
  FunctorT callback_;
};

// Uses the steady clock.
template <typename FunctorT>
class WallTimer : public GenericTimer<FunctorT> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(WallTimer)

  WallTimer(std::chrono::nanoseconds period, FunctorT callback, Context::SharedPtr context, bool autostart = true)
      : GenericTimer<FunctorT>(std::make_shared<Clock>(RCL_STEADY_TIME), period, std::move(callback),
                               std::move(context), autostart) {}
};

namespace detail {

// Converts to nanoseconds. Throws std::invalid_argument if the period is negative or does not fit.
template <typename RepT, typename RatioT>
std::chrono::nanoseconds timer_period(std::chrono::duration<RepT, RatioT> period) {
  using DoubleNanoseconds = std::chrono::duration<double, std::nano>;
  if (period < std::chrono::duration<RepT, RatioT>::zero()) {
    throw std::invalid_argument("timer period cannot be negative");
  }
  // The largest double below 2^63.
  if (std::chrono::duration_cast<DoubleNanoseconds>(period).count() > 9223372036854774784.0) {
    throw std::invalid_argument("timer period must be less than std::chrono::nanoseconds::max()");
  }
  return std::chrono::duration_cast<std::chrono::nanoseconds>(period);
}

}  // namespace detail

}  // namespace rclcpp
