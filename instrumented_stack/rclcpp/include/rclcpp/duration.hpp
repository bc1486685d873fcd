// SPDX-License-Identifier: Apache-2.0
// A length of time in nanoseconds.
#pragma once

#include <rcl/time.h>
#include <rmw/time.h>

#include <builtin_interfaces/msg/duration.hpp>
#include <builtin_interfaces/msg/time.hpp>
#include <chrono>
#include <cstdint>

namespace rclcpp {

class Duration {
 public:
  // `nanoseconds` are added to `seconds`, even if `seconds` is negative.
  Duration(int32_t seconds, uint32_t nanoseconds);
  Duration(std::chrono::nanoseconds nanoseconds) : nanoseconds_(nanoseconds.count()) {}  // NOLINT: as std::chrono
  template <class Rep, class Period>
  Duration(const std::chrono::duration<Rep, Period>& duration)  // NOLINT: as std::chrono
      : nanoseconds_(std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count()) {}
  Duration(const builtin_interfaces::msg::Duration& message);  // NOLINT: messages and objects convert freely
  explicit Duration(const rcl_duration_t& duration) : nanoseconds_(duration.nanoseconds) {}

  static Duration from_nanoseconds(rcl_duration_value_t nanoseconds);
  static Duration from_seconds(double seconds);
  static Duration from_rmw_time(rmw_time_t duration);
  // The longest duration that a message holds.
  static Duration max();

  Duration& operator=(const builtin_interfaces::msg::Duration& message);
  // A duration that the message can't hold becomes the largest or the smallest value of its fields.
  operator builtin_interfaces::msg::Duration() const;

  rcl_duration_value_t nanoseconds() const { return nanoseconds_; }
  double seconds() const;
  template <class DurationT>
  DurationT to_chrono() const {
    return std::chrono::duration_cast<DurationT>(std::chrono::nanoseconds(nanoseconds_));
  }
  // Throws std::runtime_error for a negative duration.
  rmw_time_t to_rmw_time() const;

  bool operator==(const Duration& other) const { return nanoseconds_ == other.nanoseconds_; }
  bool operator!=(const Duration& other) const { return nanoseconds_ != other.nanoseconds_; }
  bool operator<(const Duration& other) const { return nanoseconds_ < other.nanoseconds_; }
  bool operator<=(const Duration& other) const { return nanoseconds_ <= other.nanoseconds_; }
  bool operator>(const Duration& other) const { return nanoseconds_ > other.nanoseconds_; }
  bool operator>=(const Duration& other) const { return nanoseconds_ >= other.nanoseconds_; }

  // Throw std::overflow_error or std::underflow_error.
  Duration operator+(const Duration& other) const;
  Duration operator-(const Duration& other) const;
  Duration& operator+=(const Duration& other) { return *this = *this + other; }
  Duration& operator-=(const Duration& other) { return *this = *this - other; }
  // Throws std::runtime_error also for a scale that is infinite or not a number.
  Duration operator*(double scale) const;
  Duration& operator*=(double scale) { return *this = *this * scale; }

 private:
  Duration() = default;

  rcl_duration_value_t nanoseconds_ = 0;
};

// Calculate with the time in a message. Throw std::runtime_error if it is negative, std::overflow_error and
// std::underflow_error.
builtin_interfaces::msg::Time operator+(const builtin_interfaces::msg::Time& time, const Duration& duration);
builtin_interfaces::msg::Time operator-(const builtin_interfaces::msg::Time& time, const Duration& duration);

}  // namespace rclcpp
