// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "track_frames_ros/listener.hpp"

template <class NodeT>
class Listening : public testing::Test {};
using NodeKinds = testing::Types<rclcpp::Node, rclcpp_lifecycle::LifecycleNode>;
TYPED_TEST_SUITE(Listening, NodeKinds, );

TYPED_TEST(Listening, KnowsTheFramesOfItsTopics) {
  const auto node = std::make_shared<TypeParam>("node");
  track_frames_ros::Buffer buffer(node->get_clock());
  const track_frames_ros::Listener listener(buffer, node);
  const track_frames_ros::Listener with_own_node(buffer);
  track_frames_ros::Broadcaster broadcaster(node, true);
  geometry_msgs::msg::TransformStamped transform;
  transform.header.frame_id = "map";
  transform.child_frame_id = "robot";
  broadcaster.send(transform);
  EXPECT_TRUE(buffer.wait_for("map", "robot", std::chrono::seconds(60)));
}

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  rclcpp::init(argc, argv);
  const int result = RUN_ALL_TESTS();
  rclcpp::shutdown();
  return result;
}
