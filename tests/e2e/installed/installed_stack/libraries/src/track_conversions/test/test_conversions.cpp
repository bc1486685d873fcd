// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "track_conversions/conversions.hpp"

TEST(Conversions, MoveAPointToAnotherFrame) {
  geometry_msgs::msg::PointStamped point;
  point.point = track_conversions::to_message<track_conversions::Point, geometry_msgs::msg::Point>({1.0, 2.0, 3.0});
  geometry_msgs::msg::TransformStamped to_map;
  to_map.header.frame_id = "map";
  to_map.header.stamp = rclcpp::Time(2, 5);
  to_map.transform.translation.x = 0.5;
  track_conversions::transform(point, point, to_map);
  EXPECT_DOUBLE_EQ(point.point.x, 1.5);
  EXPECT_EQ(point.header.frame_id, "map");
  EXPECT_EQ(track_conversions::time_of(point.header.stamp).time_since_epoch().count(), 2'000'000'005);
}
