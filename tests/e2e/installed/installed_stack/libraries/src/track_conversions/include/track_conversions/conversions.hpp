// SPDX-License-Identifier: Apache-2.0
// Points of a program to messages and back; new types specialise `to_message` and `from_message`.
#pragma once

#include <array>
#include <geometry_msgs/msg/point.hpp>
#include <geometry_msgs/msg/point_stamped.hpp>
#include <geometry_msgs/msg/vector3.hpp>
#include <string>

#include "track_frames_ros/listener.hpp"

namespace track_conversions {

template <class T>
struct Stamped : T {
  track_frames::TimePoint stamp;
  std::string frame_id;
};

using Point = std::array<double, 3>;

template <class A, class B>
B to_message(const A&);

template <>
inline geometry_msgs::msg::Point to_message(const Point& point) {
  return geometry_msgs::build<geometry_msgs::msg::Point>().x(point[0]).y(point[1]).z(point[2]);
}

inline void transform(const geometry_msgs::msg::PointStamped& in, geometry_msgs::msg::PointStamped& out,
                      const geometry_msgs::msg::TransformStamped& transform) {
  out = in;
  out.header.frame_id = transform.header.frame_id;
  out.header.stamp = transform.header.stamp;
  out.point.x += transform.transform.translation.x;
}

inline track_frames::TimePoint time_of(const builtin_interfaces::msg::Time& stamp) {
  return track_frames::TimePoint(std::chrono::nanoseconds(rclcpp::Time(stamp).nanoseconds()));
}

}  // namespace track_conversions
