// Where the time comes from: the system's clock, a steady one, or ROS time, which a simulation may set.
#pragma once

#include <rcl/time.h>

#include <memory>
#include <mutex>

#include "rclcpp/context.hpp"
#include "rclcpp/contexts/default_context.hpp"
#include "rclcpp/duration.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/time.hpp"

namespace rclcpp {

// Copies share the underlying clock. All functions are thread safe.
class Clock {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Clock)

  explicit Clock(rcl_clock_type_t clock_type = RCL_SYSTEM_TIME);
  virtual ~Clock() = default;

  Time now() const;

  // True when the time was reached, false when the context ended first. `until` must be a time of this clock's type.
  bool sleep_until(Time until, Context::SharedPtr context = contexts::get_global_default_context());
  bool sleep_for(Duration duration, Context::SharedPtr context = contexts::get_global_default_context());

  // False while a simulation drives this clock and has not set a time yet.
  bool started() const;

  // Whether a simulation drives this clock. Throws exceptions::RCLError unless it is a ROS time clock.
  bool ros_time_is_active() const;

  rcl_clock_type_t get_clock_type() const noexcept;
  rcl_clock_t* get_clock_handle() noexcept;
  std::mutex& get_clock_mutex() noexcept;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace rclcpp
