// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/clock.hpp"

#include <condition_variable>
#include <stdexcept>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"

namespace rclcpp {

using detail::require_ok;

namespace {

void require_valid(const Context::SharedPtr& context) {
  if (!context || !context->is_valid()) {
    throw std::runtime_error("context cannot be slept with because it's invalid");
  }
}

}  // namespace

struct Clock::Impl {
  explicit Impl(rcl_clock_type_t clock_type) {
    rcl_allocator_t allocator = rcl_get_default_allocator();
    require_ok(rcl_clock_init(clock_type, &rcl_clock, &allocator), "failed to initialize rcl clock");
  }
  ~Impl() { detail::log_error(rcl_clock_fini(&rcl_clock), "failed to finalize a clock"); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // Lets sleeping threads look again whether they have slept enough.
  void wake() {
    { const std::lock_guard lock(sleep_mutex); }
    woken.notify_all();
  }

  rcl_clock_t rcl_clock{};
  std::mutex mutex;  // held while the clock jumps; taken before sleep_mutex
  std::mutex sleep_mutex;
  std::condition_variable woken;
  bool cancelled = false;
};

Clock::Clock(rcl_clock_type_t clock_type) : impl_(std::make_shared<Impl>(clock_type)) {}

Time Clock::now() const {
  rcl_time_point_value_t now = 0;
  require_ok(rcl_clock_get_now(&impl_->rcl_clock, &now), "could not get current time stamp");
  return Time(now, impl_->rcl_clock.type);
}

bool Clock::sleep_until(Time until, Context::SharedPtr context) {
  require_valid(context);
  if (until.get_clock_type() != get_clock_type()) {
    throw std::runtime_error("until's clock type does not match this clock's type");
  }
  return sleep(until, context);
}

bool Clock::sleep(const Time& until, const Context::SharedPtr& context) {
  const std::shared_ptr<Impl> impl = impl_;
  const auto wake = [impl] { impl->wake(); };
  JumpHandler::SharedPtr jump_handler;
  bool simulated = false;
  if (get_clock_type() == RCL_ROS_TIME) {
    const rcl_jump_threshold_t every_jump{.on_clock_change = true, .min_forward = {1}, .min_backward = {-1}};
    jump_handler = create_jump_callback(
        nullptr, [wake](const rcl_time_jump_t&) { wake(); }, every_jump);
    simulated = ros_time_is_active();
  }
  const OnShutdownCallbackHandle shutdown_handle = context->add_on_shutdown_callback(wake);
  const auto is_other_time = [&] { return jump_handler && ros_time_is_active() != simulated; };

  bool cancelled = false;
  {
    std::unique_lock lock(impl->sleep_mutex);
    const auto is_over = [&] { return impl->cancelled || !context->is_valid() || is_other_time() || now() >= until; };
    while (!is_over()) {
      const std::chrono::nanoseconds nanoseconds(until.nanoseconds());
      if (simulated) {
        impl->woken.wait(lock);
      } else if (get_clock_type() == RCL_STEADY_TIME) {
        impl->woken.wait_until(lock, std::chrono::steady_clock::time_point(nanoseconds));
      } else {
        impl->woken.wait_until(lock, std::chrono::system_clock::time_point(nanoseconds));
      }
    }
    cancelled = std::exchange(impl->cancelled, false);
  }
  context->remove_on_shutdown_callback(shutdown_handle);
  return !cancelled && context->is_valid() && !is_other_time() && now() >= until;
}

bool Clock::sleep_for(Duration duration, Context::SharedPtr context) {
  return sleep_until(now() + duration, std::move(context));
}

bool Clock::started() const {
  return get_clock_type() != RCL_ROS_TIME || !ros_time_is_active() || now().nanoseconds() > 0;
}

bool Clock::wait_until_started(Context::SharedPtr context) {
  require_valid(context);
  return started() || sleep_until(Time(0, 1, get_clock_type()), std::move(context)) || started();
}

bool Clock::wait_until_started(const Duration& timeout, Context::SharedPtr context, const Duration& wait_tick_ns) {
  require_valid(context);
  // Simulated time cannot measure how long it takes to start.
  Clock steady(RCL_STEADY_TIME);
  const Time begin = steady.now();
  while (!started()) {
    if (steady.now() - begin >= timeout || !steady.sleep_for(wait_tick_ns, context)) {
      return started();
    }
  }
  return true;
}

void Clock::cancel_sleep_or_wait() {
  {
    const std::lock_guard lock(impl_->sleep_mutex);
    impl_->cancelled = true;
  }
  impl_->woken.notify_all();
}

JumpHandler::SharedPtr Clock::create_jump_callback(JumpHandler::pre_callback_t pre_callback,
                                                   JumpHandler::post_callback_t post_callback,
                                                   const rcl_jump_threshold_t& threshold) {
  auto handler = std::make_unique<JumpHandler>(std::move(pre_callback), std::move(post_callback), threshold);
  const rcl_jump_callback_t call = [](const rcl_time_jump_t* jump, bool before_jump, void* user_data) {
    const auto& of_user = *static_cast<const JumpHandler*>(user_data);
    if (before_jump && of_user.pre_callback) {
      of_user.pre_callback();
    } else if (!before_jump && of_user.post_callback) {
      of_user.post_callback(*jump);
    }
  };
  {
    const std::lock_guard lock(impl_->mutex);
    require_ok(rcl_clock_add_jump_callback(&impl_->rcl_clock, threshold, call, handler.get()),
               "failed to add a jump callback");
  }
  // The handler may outlive the clock.
  return JumpHandler::SharedPtr(handler.release(), [call, weak_impl = std::weak_ptr<Impl>(impl_)](JumpHandler* ended) {
    if (const std::shared_ptr<Impl> impl = weak_impl.lock()) {
      const std::lock_guard lock(impl->mutex);
      detail::log_error(rcl_clock_remove_jump_callback(&impl->rcl_clock, call, ended),
                        "failed to remove a jump callback");
    }
    delete ended;
  });
}

bool Clock::ros_time_is_active() const {
  bool active = false;
  require_ok(rcl_is_enabled_ros_time_override(&impl_->rcl_clock, &active), "failed to check ros_time_override_status");
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
