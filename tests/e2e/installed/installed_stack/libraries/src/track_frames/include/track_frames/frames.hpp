// SPDX-License-Identifier: Apache-2.0
// Where frames are, by time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <geometry_msgs/msg/transform_stamped.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

namespace track_frames {

using Duration = std::chrono::nanoseconds;
using TimePoint = std::chrono::time_point<std::chrono::system_clock, Duration>;

class LookupError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Implemented by the package above, which knows rclcpp.
class FramesInterface {
 public:
  virtual ~FramesInterface() = default;
  virtual geometry_msgs::msg::TransformStamped lookup(const std::string& target, const std::string& source) const = 0;
};

class Frames : public FramesInterface {
 public:
  // Returns false for a frame without a name.
  bool set(const geometry_msgs::msg::TransformStamped& transform, bool is_static);
  geometry_msgs::msg::TransformStamped lookup(const std::string& target, const std::string& source) const override;
  bool wait_for(const std::string& target, const std::string& source, Duration timeout) const;
  void clear();

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::map<std::string, geometry_msgs::msg::TransformStamped> by_child_;
  std::map<std::string, geometry_msgs::msg::TransformStamped> static_by_child_;
};

}  // namespace track_frames
