// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/timer.hpp"

#include <tracetools/tracetools.h>

#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp {

using detail::require_ok;

TimerBase::TimerBase(Clock::SharedPtr clock, std::chrono::nanoseconds period, Context::SharedPtr context,
                     bool autostart)
    : clock_(std::move(clock)) {
  if (!context) {
    context = contexts::get_global_default_context();
  }
  const std::shared_ptr<rcl_context_t> rcl_context = context->get_rcl_context();
  auto timer = std::make_unique<rcl_timer_t>(rcl_get_zero_initialized_timer());
  {
    const std::lock_guard lock(clock_->get_clock_mutex());
    require_ok(rcl_timer_init2(timer.get(), clock_->get_clock_handle(), rcl_context.get(), period.count(), nullptr,
                               rcl_get_default_allocator(), autostart),
               "couldn't initialize rcl timer handle");
  }
  // An executor may hold the rcl timer longer than this object lives. The rcl timer needs its clock and its context.
  timer_handle_.reset(timer.release(), [clock = clock_, rcl_context](rcl_timer_t* handle) {
    {
      const std::lock_guard lock(clock->get_clock_mutex());
      detail::log_error(rcl_timer_fini(handle), "failed to finalize a timer");
    }
    delete handle;
  });
}

TimerBase::~TimerBase() {
  clear_on_reset_callback();
  if (callback_) {
    TRACETOOLS_EXT_TRACEPOINT(rclcpp_callback_fini, callback_);
  }
  if (const CallbackGroup::SharedPtr group = callback_group_.lock()) {
    group->entity_removed();
  }
}

void TimerBase::cancel() {
  require_ok(rcl_timer_cancel(timer_handle_.get()), "couldn't cancel timer");
}

bool TimerBase::is_canceled() {
  bool canceled = false;
  require_ok(rcl_timer_is_canceled(timer_handle_.get(), &canceled), "couldn't get timer cancelled state");
  return canceled;
}

void TimerBase::reset() {
  require_ok(rcl_timer_reset(timer_handle_.get()), "couldn't reset timer");
}

std::chrono::nanoseconds TimerBase::time_until_trigger() {
  int64_t time_until_next_call = 0;
  const rcl_ret_t ret = rcl_timer_get_time_until_next_call(timer_handle_.get(), &time_until_next_call);
  if (ret == RCL_RET_TIMER_CANCELED) {
    rcl_reset_error();
    return std::chrono::nanoseconds::max();
  }
  require_ok(ret, "timer could not get time until next call");
  return std::chrono::nanoseconds(time_until_next_call);
}

bool TimerBase::is_ready() {
  bool ready = false;
  require_ok(rcl_timer_is_ready(timer_handle_.get(), &ready), "failed to check timer");
  return ready;
}

std::shared_ptr<void> TimerBase::call() {
  auto info = std::make_shared<rcl_timer_call_info_t>();
  const rcl_ret_t ret = rcl_timer_call_with_info(timer_handle_.get(), info.get());
  if (ret == RCL_RET_TIMER_CANCELED) {
    rcl_reset_error();
    return nullptr;
  }
  require_ok(ret, "failed to notify timer that callback occurred");
  return info;
}

void TimerBase::execute_callback(const std::shared_ptr<void>& data) {
  const auto& info = *static_cast<const rcl_timer_call_info_t*>(data.get());
  const rcl_clock_type_t clock_type = clock_->get_clock_type();
  execute({Time(info.expected_call_time, clock_type), Time(info.actual_call_time, clock_type)});
}

void TimerBase::execute_callback() {
  const Time now = clock_->now();
  execute({now, now});
}

void TimerBase::execute(const TimerInfo& info) {
  TRACETOOLS_TRACEPOINT(callback_start, callback_, false);
  run(info);
  TRACETOOLS_TRACEPOINT(callback_end, callback_);
}

void TimerBase::trace_callback(const void* callback, const detail::CallbackSymbol& symbol) {
  callback_ = callback;
  TRACETOOLS_TRACEPOINT(rclcpp_timer_callback_added, static_cast<const void*>(timer_handle_.get()), callback);
  symbol.trace_registration(callback);
}

void TimerBase::set_on_reset_callback(std::function<void(size_t)> callback) {
  on_ready_.set(std::move(callback), "set_on_reset_callback", "timer",
                [this](rcl_event_callback_t function, const void* user_data) {
                  require_ok(rcl_timer_set_on_change_callback(timer_handle_.get(), function, user_data),
                             "failed to set the callback of a timer");
                });
}

void TimerBase::clear_on_reset_callback() {
  on_ready_.clear([this](rcl_event_callback_t function, const void* user_data) {
    detail::ignore_error(rcl_timer_set_on_change_callback(timer_handle_.get(), function, user_data));
  });
}

}  // namespace rclcpp
