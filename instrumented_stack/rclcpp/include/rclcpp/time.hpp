// SPDX-License-Identifier: Apache-2.0
// A point in time on a clock. Comparing or subtracting times of different clocks throws std::runtime_error.
#pragma once

#include <rcl/time.h>

#include <builtin_interfaces/msg/time.hpp>
#include <cstdint>

#include "rclcpp/duration.hpp"

namespace rclcpp {

class Time {
 public:
  // These two throw std::runtime_error for negative seconds. Arithmetic and nanoseconds may give a negative time.
  Time(int32_t seconds, uint32_t nanoseconds, rcl_clock_type_t clock_type = RCL_SYSTEM_TIME);
  Time(const builtin_interfaces::msg::Time& message, rcl_clock_type_t clock_type = RCL_ROS_TIME);  // NOLINT

  explicit Time(int64_t nanoseconds = 0, rcl_clock_type_t clock_type = RCL_SYSTEM_TIME);
  explicit Time(const rcl_time_point_t& time_point);

  // The last time that a message holds.
  static Time max(rcl_clock_type_t clock_type = RCL_SYSTEM_TIME);

  Time& operator=(const builtin_interfaces::msg::Time& message);
  // A time that the message can't hold becomes the largest or the smallest value of its fields.
  operator builtin_interfaces::msg::Time() const;

  rcl_time_point_value_t nanoseconds() const { return nanoseconds_; }
  double seconds() const;
  rcl_clock_type_t get_clock_type() const { return clock_type_; }

  bool operator==(const Time& other) const;
  bool operator!=(const Time& other) const { return !(*this == other); }
  bool operator<(const Time& other) const;
  bool operator<=(const Time& other) const { return !(other < *this); }
  bool operator>(const Time& other) const { return other < *this; }
  bool operator>=(const Time& other) const { return !(*this < other); }

  // Throw std::overflow_error or std::underflow_error.
  Time operator+(const Duration& duration) const;
  Time operator-(const Duration& duration) const;
  Duration operator-(const Time& other) const;
  Time& operator+=(const Duration& duration) { return *this = *this + duration; }
  Time& operator-=(const Duration& duration) { return *this = *this - duration; }

 private:
  void require_same_clock(const Time& other) const;

  rcl_time_point_value_t nanoseconds_;
  rcl_clock_type_t clock_type_;
};

inline Time operator+(const Duration& duration, const Time& time) {
  return time + duration;
}

// A message, for a time of any sign within its range; times outside become the first or the last that it can hold.
builtin_interfaces::msg::Time convert_rcl_time_to_sec_nanos(const rcl_time_point_value_t& time_point);

}  // namespace rclcpp
