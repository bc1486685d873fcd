// SPDX-License-Identifier: Apache-2.0
// Keeps a loop at a frequency: `while (rclcpp::ok()) { …; rate.sleep(); }`.
#pragma once

#include <chrono>

#include "rclcpp/clock.hpp"
#include "rclcpp/duration.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {

class RateBase {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(RateBase)
  virtual ~RateBase() = default;
  virtual bool sleep() = 0;
  virtual rcl_clock_type_t get_type() const = 0;
  virtual void reset() = 0;
  [[deprecated("use get_type() instead")]] virtual bool is_steady() const { return get_type() == RCL_STEADY_TIME; }
};

class Rate : public RateBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Rate)

  // Throws std::invalid_argument unless the rate, in Hz, or the period is positive.
  explicit Rate(double rate, Clock::SharedPtr clock = std::make_shared<Clock>(RCL_SYSTEM_TIME));
  explicit Rate(const Duration& period, Clock::SharedPtr clock = std::make_shared<Clock>(RCL_SYSTEM_TIME));

  // Sleeps until the end of the current interval. Returns false if the context ended, or if the interval is already
  // over. The next interval then starts on schedule, or now if a whole interval was missed.
  bool sleep() override;
  rcl_clock_type_t get_type() const override { return clock_->get_clock_type(); }
  // The next interval starts now.
  void reset() override;
  std::chrono::nanoseconds period() const { return period_.to_chrono<std::chrono::nanoseconds>(); }

 private:
  Clock::SharedPtr clock_;
  Duration period_;
  Time last_interval_;
};

// Uses the steady clock.
class WallRate : public Rate {
 public:
  explicit WallRate(double rate) : Rate(rate, std::make_shared<Clock>(RCL_STEADY_TIME)) {}
  explicit WallRate(const Duration& period) : Rate(period, std::make_shared<Clock>(RCL_STEADY_TIME)) {}
};

class ROSRate : public Rate {
 public:
  explicit ROSRate(double rate) : Rate(rate, std::make_shared<Clock>(RCL_ROS_TIME)) {}
  explicit ROSRate(const Duration& period) : Rate(period, std::make_shared<Clock>(RCL_ROS_TIME)) {}
};

// Uses the clock of a C++ type, as it was before Rate took clocks.
template <typename ClockT = std::chrono::high_resolution_clock>
class [[deprecated("use rclcpp::Rate class instead of GenericRate")]] GenericRate : public RateBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericRate)

  explicit GenericRate(double rate)
      : GenericRate(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(1.0 / rate))) {}
  explicit GenericRate(std::chrono::nanoseconds period) : period_(period), last_interval_(ClockT::now()) {}

  bool sleep() override {
    const auto now = ClockT::now();
    auto next = last_interval_ + std::chrono::duration_cast<typename ClockT::duration>(period_);
    if (now < last_interval_) {
      next = now + std::chrono::duration_cast<typename ClockT::duration>(period_);  // time has jumped back
    }
    last_interval_ = next;
    if (next <= now) {
      if (now > next + period_) {
        last_interval_ = now;
      }
      return false;
    }
    return sleep_for(std::chrono::duration_cast<std::chrono::nanoseconds>(next - now));
  }
  bool is_steady() const override { return ClockT::is_steady; }
  rcl_clock_type_t get_type() const override { return ClockT::is_steady ? RCL_STEADY_TIME : RCL_SYSTEM_TIME; }
  void reset() override { last_interval_ = ClockT::now(); }
  std::chrono::nanoseconds period() const { return period_; }

 private:
  std::chrono::nanoseconds period_;
  std::chrono::time_point<ClockT> last_interval_;
};

}  // namespace rclcpp
