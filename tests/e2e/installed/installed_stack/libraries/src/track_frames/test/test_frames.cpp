// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "track_frames/frames.hpp"

TEST(Frames, AreLookedUp) {
  track_frames::Frames frames;
  geometry_msgs::msg::TransformStamped transform;
  transform.header.frame_id = "map";
  EXPECT_FALSE(frames.set(transform, true));
  transform.child_frame_id = "robot";
  EXPECT_TRUE(frames.set(transform, false));
  EXPECT_EQ(frames.lookup("map", "robot"), transform);
  frames.clear();
  EXPECT_THROW(frames.lookup("map", "robot"), track_frames::LookupError);
}
