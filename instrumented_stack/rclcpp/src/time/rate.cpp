// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/rate.hpp"

#include <stdexcept>
#include <utility>

namespace rclcpp {

namespace {

Duration period_of(double rate) {
  if (!(rate > 0.0)) {
    throw std::invalid_argument("rate must be greater than 0");
  }
  return Duration::from_seconds(1.0 / rate);
}

}  // namespace

Rate::Rate(double rate, Clock::SharedPtr clock) : Rate(period_of(rate), std::move(clock)) {}

Rate::Rate(const Duration& period, Clock::SharedPtr clock)
    : clock_(std::move(clock)), period_(period), last_interval_(clock_->now()) {
  if (period <= Duration(0, 0)) {
    throw std::invalid_argument("period must be greater than 0");
  }
}

bool Rate::sleep() {
  const Time now = clock_->now();
  if (now < last_interval_) {
    last_interval_ = now;  // the clock has jumped back
  }
  const Time next_interval = last_interval_ + period_;
  last_interval_ += period_;
  if (next_interval <= now) {
    if (now > next_interval + period_) {
      last_interval_ = now;
    }
    return false;
  }
  // Not sleep_until(): it throws if the context has ended, which may happen between any two calls of a program's loop.
  return clock_->sleep(next_interval, contexts::get_global_default_context());
}

void Rate::reset() {
  last_interval_ = clock_->now();
}

}  // namespace rclcpp
