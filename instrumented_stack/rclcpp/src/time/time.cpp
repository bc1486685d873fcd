// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/time.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "rclcpp/duration.hpp"

namespace rclcpp {

namespace {

constexpr int64_t kNanosecondsPerSecond = 1'000'000'000;

// The last point in time, and the longest duration, that a message holds.
constexpr int64_t kMaxOfMessage =
    std::numeric_limits<int32_t>::max() * kNanosecondsPerSecond + (kNanosecondsPerSecond - 1);

int64_t sum(int64_t a, int64_t b) {
  int64_t result = 0;
  if (__builtin_add_overflow(a, b, &result)) {
    if (b > 0) {
      throw std::overflow_error("addition leads to int64_t overflow");
    }
    throw std::underflow_error("addition leads to int64_t underflow");
  }
  return result;
}

// `what` is "time" or "duration".
int64_t difference(int64_t a, int64_t b, const std::string& what) {
  int64_t result = 0;
  if (__builtin_sub_overflow(a, b, &result)) {
    if (b < 0) {
      throw std::overflow_error(what + " subtraction leads to int64_t overflow");
    }
    throw std::underflow_error(what + " subtraction leads to int64_t underflow");
  }
  return result;
}

// Seconds rounded down, plus the remaining nanoseconds, as messages require. What a message can't hold becomes the
// largest or the smallest value of its fields.
template <typename MessageT>
MessageT to_message(int64_t total_nanoseconds) {
  int64_t seconds = total_nanoseconds / kNanosecondsPerSecond;
  int64_t rest = total_nanoseconds % kNanosecondsPerSecond;
  if (rest < 0) {
    rest += kNanosecondsPerSecond;
    --seconds;
  }
  MessageT message;
  if (seconds > std::numeric_limits<int32_t>::max()) {
    message.sec = std::numeric_limits<int32_t>::max();
    message.nanosec = std::numeric_limits<uint32_t>::max();
    return message;
  }
  if (seconds < std::numeric_limits<int32_t>::min()) {
    message.sec = std::numeric_limits<int32_t>::min();
    message.nanosec = 0;
    return message;
  }
  message.sec = static_cast<int32_t>(seconds);
  message.nanosec = static_cast<uint32_t>(rest);
  return message;
}

}  // namespace

Duration::Duration(int32_t seconds, uint32_t nanoseconds)
    : nanoseconds_(int64_t{seconds} * kNanosecondsPerSecond + nanoseconds) {}

Duration::Duration(const builtin_interfaces::msg::Duration& message) : Duration(message.sec, message.nanosec) {}

Duration Duration::from_nanoseconds(rcl_duration_value_t nanoseconds) {
  return Duration(std::chrono::nanoseconds(nanoseconds));
}

Duration Duration::from_seconds(double seconds) {
  return from_nanoseconds(static_cast<rcl_duration_value_t>(seconds * static_cast<double>(kNanosecondsPerSecond)));
}

Duration Duration::from_rmw_time(rmw_time_t duration) {
  return from_nanoseconds(rmw_time_total_nsec(duration));
}

Duration Duration::max() {
  return from_nanoseconds(kMaxOfMessage);
}

Duration& Duration::operator=(const builtin_interfaces::msg::Duration& message) {
  return *this = Duration(message);
}

Duration::operator builtin_interfaces::msg::Duration() const {
  return to_message<builtin_interfaces::msg::Duration>(nanoseconds_);
}

double Duration::seconds() const {
  return static_cast<double>(nanoseconds_) / static_cast<double>(kNanosecondsPerSecond);
}

rmw_time_t Duration::to_rmw_time() const {
  if (nanoseconds_ < 0) {
    throw std::runtime_error("rmw_time_t cannot be negative");
  }
  return rmw_time_from_nsec(nanoseconds_);
}

Duration Duration::operator+(const Duration& other) const {
  return from_nanoseconds(sum(nanoseconds_, other.nanoseconds_));
}

Duration Duration::operator-(const Duration& other) const {
  const int64_t result = difference(nanoseconds_, other.nanoseconds_, "duration");
  // As in rclcpp, the sum of the two lengths must not exceed the longest duration.
  if (result == std::numeric_limits<int64_t>::min() && nanoseconds_ < 0 && other.nanoseconds_ > 0) {
    throw std::underflow_error("duration subtraction leads to int64_t underflow");
  }
  return from_nanoseconds(result);
}

Duration Duration::operator*(double scale) const {
  if (!std::isfinite(scale)) {
    throw std::runtime_error("abnormal scale in rclcpp::Duration");
  }
  const long double scaled = static_cast<long double>(nanoseconds_) * static_cast<long double>(scale);
  if (scaled > static_cast<long double>(std::numeric_limits<int64_t>::max())) {
    throw std::overflow_error("duration scaling leads to int64_t overflow");
  }
  if (scaled < static_cast<long double>(std::numeric_limits<int64_t>::min())) {
    throw std::underflow_error("duration scaling leads to int64_t underflow");
  }
  return from_nanoseconds(static_cast<int64_t>(scaled));
}

namespace {

int64_t nanoseconds_of(const builtin_interfaces::msg::Time& time) {
  if (time.sec < 0) {
    throw std::runtime_error("message time is negative");
  }
  return int64_t{time.sec} * kNanosecondsPerSecond + time.nanosec;
}

}  // namespace

builtin_interfaces::msg::Time operator+(const builtin_interfaces::msg::Time& time, const Duration& duration) {
  return to_message<builtin_interfaces::msg::Time>(sum(nanoseconds_of(time), duration.nanoseconds()));
}

builtin_interfaces::msg::Time operator-(const builtin_interfaces::msg::Time& time, const Duration& duration) {
  return to_message<builtin_interfaces::msg::Time>(difference(nanoseconds_of(time), duration.nanoseconds(), "time"));
}

Time::Time(int32_t seconds, uint32_t nanoseconds, rcl_clock_type_t clock_type)
    : Time(int64_t{seconds} * kNanosecondsPerSecond + nanoseconds, clock_type) {
  if (seconds < 0) {
    throw std::runtime_error("cannot store a negative time point in rclcpp::Time");
  }
}

Time::Time(int64_t nanoseconds, rcl_clock_type_t clock_type) : nanoseconds_(nanoseconds), clock_type_(clock_type) {}

Time::Time(const builtin_interfaces::msg::Time& message, rcl_clock_type_t clock_type)
    : Time(message.sec, message.nanosec, clock_type) {}

Time::Time(const rcl_time_point_t& time_point)
    : nanoseconds_(time_point.nanoseconds), clock_type_(time_point.clock_type) {}

Time Time::max(rcl_clock_type_t clock_type) {
  return Time(kMaxOfMessage, clock_type);
}

Time& Time::operator=(const builtin_interfaces::msg::Time& message) {
  return *this = Time(message);
}

Time::operator builtin_interfaces::msg::Time() const {
  return to_message<builtin_interfaces::msg::Time>(nanoseconds_);
}

double Time::seconds() const {
  return static_cast<double>(nanoseconds_) / static_cast<double>(kNanosecondsPerSecond);
}

void Time::require_same_clock(const Time& other) const {
  if (clock_type_ != other.clock_type_) {
    throw std::runtime_error("can't compare times with different time sources");
  }
}

bool Time::operator==(const Time& other) const {
  require_same_clock(other);
  return nanoseconds_ == other.nanoseconds_;
}

bool Time::operator<(const Time& other) const {
  require_same_clock(other);
  return nanoseconds_ < other.nanoseconds_;
}

Time Time::operator+(const Duration& duration) const {
  return Time(sum(nanoseconds_, duration.nanoseconds()), clock_type_);
}

Time Time::operator-(const Duration& duration) const {
  return Time(difference(nanoseconds_, duration.nanoseconds(), "time"), clock_type_);
}

Duration Time::operator-(const Time& other) const {
  if (clock_type_ != other.clock_type_) {
    throw std::runtime_error("can't subtract times with different time sources [" + std::to_string(clock_type_) +
                             " != " + std::to_string(other.clock_type_) + "]");
  }
  return Duration::from_nanoseconds(difference(nanoseconds_, other.nanoseconds_, "time"));
}

builtin_interfaces::msg::Time convert_rcl_time_to_sec_nanos(const rcl_time_point_value_t& time_point) {
  return to_message<builtin_interfaces::msg::Time>(time_point);
}

}  // namespace rclcpp
