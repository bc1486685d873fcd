// Keeps a loop at a frequency: `while (rclcpp::ok()) { …; rate.sleep(); }`.
#pragma once

#include "rclcpp/clock.hpp"
#include "rclcpp/duration.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/time.hpp"

namespace rclcpp {

class RateBase {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(RateBase)
  virtual ~RateBase() = default;
  virtual bool sleep() = 0;
  virtual rcl_clock_type_t get_type() const = 0;
  virtual void reset() = 0;
};

class Rate : public RateBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Rate)

  // Throws std::invalid_argument unless the rate, in Hz, or the period is positive.
  explicit Rate(double rate, Clock::SharedPtr clock = std::make_shared<Clock>(RCL_SYSTEM_TIME));
  explicit Rate(const Duration& period, Clock::SharedPtr clock = std::make_shared<Clock>(RCL_SYSTEM_TIME));

  // Sleeps to the end of the current interval. False when that has passed already (the next interval then starts at its
  // proper time, or now if a whole interval was missed), or when the context ended.
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

// On the steady clock.
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

}  // namespace rclcpp
