// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <condition_variable>
#include <stdexcept>
#include <utility>

#include "rclcpp/clock.hpp"

namespace rclcpp {

struct ClockWaiter::Impl {
  explicit Impl(const Clock::SharedPtr& its_clock) : clock(its_clock) {}

  Clock::SharedPtr clock;
  std::condition_variable woken;
};

ClockWaiter::ClockWaiter(const Clock::SharedPtr& clock) : impl_(std::make_unique<Impl>(clock)) {}
ClockWaiter::~ClockWaiter() = default;

bool ClockWaiter::wait_until(std::unique_lock<std::mutex>& lock, const Time& abs_time,
                             const std::function<bool()>& pred) {
  Clock& clock = *impl_->clock;
  const bool is_ros_time = clock.get_clock_type() == RCL_ROS_TIME;
  JumpHandler::SharedPtr jump_handler;
  bool simulated = false;
  if (is_ros_time) {
    // A jump that comes while `lock` is held waits for the mutex, so that none is missed. The clock's mutex is taken
    // before this one where the clock jumps, so it must not be taken after it here.
    lock.unlock();
    const rcl_jump_threshold_t every_jump{.on_clock_change = true, .min_forward = {1}, .min_backward = {-1}};
    jump_handler = clock.create_jump_callback(
        nullptr,
        [this, mutex = lock.mutex()](const rcl_time_jump_t&) {
          { const std::lock_guard wait(*mutex); }
          impl_->woken.notify_all();
        },
        every_jump);
    simulated = clock.ros_time_is_active();
    lock.lock();
  }
  const auto is_over = [&] {
    return pred() || clock.now() >= abs_time || (is_ros_time && clock.ros_time_is_active() != simulated);
  };
  while (!is_over()) {
    const std::chrono::nanoseconds nanoseconds(abs_time.nanoseconds());
    if (simulated) {
      impl_->woken.wait(lock);
    } else if (clock.get_clock_type() == RCL_STEADY_TIME) {
      impl_->woken.wait_until(lock, std::chrono::steady_clock::time_point(nanoseconds));
    } else {
      impl_->woken.wait_until(lock, std::chrono::system_clock::time_point(nanoseconds));
    }
  }
  if (jump_handler) {
    lock.unlock();
    jump_handler.reset();
    lock.lock();
  }
  return pred();
}

void ClockWaiter::notify_one() {
  impl_->woken.notify_one();
}

ClockConditionalVariable::ClockConditionalVariable(const Clock::SharedPtr& clock, Context::SharedPtr context)
    : context_(std::move(context)), waiter_(clock) {
  if (!context_ || !context_->is_valid()) {
    throw std::runtime_error("context cannot be slept with because it's invalid");
  }
  shutdown_handle_ = context_->add_on_shutdown_callback([this] {
    {
      const std::lock_guard lock(mutex_);
      shut_down_ = true;
    }
    waiter_.notify_one();
  });
}

ClockConditionalVariable::~ClockConditionalVariable() {
  context_->remove_on_shutdown_callback(shutdown_handle_);
}

bool ClockConditionalVariable::wait_until(std::unique_lock<std::mutex>& lock, Time until,
                                          const std::function<bool()>& pred) {
  if (lock.mutex() != &mutex_) {
    throw std::runtime_error(
        "ClockConditionalVariable::wait_until: Internal error, given lock does not use mutex returned by "
        "this->mutex()");
  }
  waiter_.wait_until(lock, until, [this, &pred] { return shut_down_ || pred(); });
  return true;
}

void ClockConditionalVariable::notify_one() {
  waiter_.notify_one();
}

}  // namespace rclcpp
