#include "rclcpp/clock.hpp"

#include <stdexcept>
#include <utility>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

struct Clock::Impl {
  explicit Impl(rcl_clock_type_t clock_type) {
    rcl_allocator_t allocator = rcl_get_default_allocator();
    const rcl_ret_t ret = rcl_clock_init(clock_type, &rcl_clock, &allocator);
    if (ret != RCL_RET_OK) {
      exceptions::throw_from_rcl_error(ret, "failed to initialize rcl clock");
    }
  }
  ~Impl() {
    if (rcl_clock_fini(&rcl_clock) != RCL_RET_OK) {
      RCLCPP_ERROR(get_logger("rclcpp"), "failed to finalize a clock: %s", rcl_get_error_string().str);
      rcl_reset_error();
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  rcl_clock_t rcl_clock{};
  std::mutex mutex;
};

Clock::Clock(rcl_clock_type_t clock_type) : impl_(std::make_shared<Impl>(clock_type)) {}

Time Clock::now() const {
  rcl_time_point_value_t now = 0;
  const rcl_ret_t ret = rcl_clock_get_now(&impl_->rcl_clock, &now);
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "could not get current time stamp");
  }
  return Time(now, impl_->rcl_clock.type);
}

bool Clock::sleep_until(Time until, Context::SharedPtr context) {
  if (!context || !context->is_valid()) {
    throw std::runtime_error("context cannot be slept with because it's invalid");
  }
  if (until.get_clock_type() != get_clock_type()) {
    throw std::runtime_error("until's clock type does not match this clock's type");
  }
  // In a loop: the system's clock may be set while we sleep.
  for (Time current = now(); current < until; current = now()) {
    if (!context->sleep_for((until - current).to_chrono<std::chrono::nanoseconds>())) {
      return false;
    }
  }
  return context->is_valid();
}

bool Clock::sleep_for(Duration duration, Context::SharedPtr context) {
  return sleep_until(now() + duration, std::move(context));
}

bool Clock::started() const {
  return get_clock_type() != RCL_ROS_TIME || !ros_time_is_active() || now().nanoseconds() > 0;
}

bool Clock::ros_time_is_active() const {
  bool active = false;
  const rcl_ret_t ret = rcl_is_enabled_ros_time_override(&impl_->rcl_clock, &active);
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, "failed to check ros_time_override_status");
  }
  return active;
}

rcl_clock_type_t Clock::get_clock_type() const noexcept {
  return impl_->rcl_clock.type;
}
rcl_clock_t* Clock::get_clock_handle() noexcept {
  return &impl_->rcl_clock;
}
std::mutex& Clock::get_clock_mutex() noexcept {
  return impl_->mutex;
}

}  // namespace rclcpp
