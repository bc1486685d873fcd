// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rclcpp_lifecycle/lifecycle_node.hpp"
#include "sensor_msgs/msg/imu.hpp"
#include "sensor_msgs/msg/range.hpp"
#include "track_filters/filters.hpp"

using sensor_msgs::msg::Imu;
using sensor_msgs::msg::Range;
static_assert(track_filters::HasHeader<Imu>::value && !track_filters::HasHeader<builtin_interfaces::msg::Time>::value);

TEST(Pairs, HaveOneStamp) {
  rclcpp::init(0, nullptr);
  const auto node = std::make_shared<rclcpp::Node>("node");
  const auto lifecycle_node = std::make_shared<rclcpp_lifecycle::LifecycleNode>("lifecycle_node");
  track_filters::Subscriber<Imu> imus(*node, "imu", rclcpp::QoS(10));
  track_filters::Subscriber<Range> ranges(*lifecycle_node, "range", rclcpp::SensorDataQoS().reliable());
  ranges.unsubscribe();
  ranges.subscribe();
  std::vector<int32_t> seconds;
  track_filters::Pairs<Imu, Range> pairs(imus, ranges, [&](const auto& imu, const auto& range) {
    EXPECT_EQ(imu->header.stamp, range->header.stamp);
    seconds.push_back(imu->header.stamp.sec);
  });
  const auto imu_publisher = node->create_publisher<Imu>("imu", 10);
  const auto range_publisher = node->create_publisher<Range>("range", rclcpp::SensorDataQoS().reliable());
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  executor.add_node(lifecycle_node->get_node_base_interface());
  while (imu_publisher->get_subscription_count() == 0 || range_publisher->get_subscription_count() == 0) {
    executor.spin_once(std::chrono::milliseconds(10));
  }
  for (const int32_t second : {1, 2, 3}) {
    Imu imu;
    imu.header.stamp.sec = second;
    imu_publisher->publish(imu);
    if (second != 2) {
      Range range;
      range.header.stamp = imu.header.stamp;
      range_publisher->publish(range);
    }
  }
  while (seconds.size() < 2) {
    executor.spin_once();
  }
  EXPECT_EQ(seconds, (std::vector<int32_t>{1, 3}));
  rclcpp::shutdown();
}
