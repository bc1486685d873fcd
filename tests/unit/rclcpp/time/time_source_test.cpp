// SPDX-License-Identifier: Apache-2.0
// Simulated time arrives even if nobody spins the node.
#include <future>
#include <rclcpp/time_source.hpp>
#include <rosgraph_msgs/msg/clock.hpp>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using rosgraph_msgs::msg::Clock;

rclcpp::NodeOptions simulated() {
  return rclcpp::NodeOptions().parameter_overrides({rclcpp::Parameter("use_sim_time", true)});
}

class TimeSource : public RosTest {
 protected:
  // Publishes the time again and again until `condition` holds.
  template <typename ConditionT>
  void simulate(int32_t seconds, ConditionT condition) {
    Clock time;
    time.clock.sec = seconds;
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!condition()) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline);
      clock_->publish(time);
      rclcpp::sleep_for(std::chrono::milliseconds(2));
    }
  }

  rclcpp::Node::SharedPtr simulator_ = std::make_shared<rclcpp::Node>("simulator");
  rclcpp::Publisher<Clock>::SharedPtr clock_ = simulator_->create_publisher<Clock>("/clock", rclcpp::ClockQoS());
};

TEST_F(TimeSource, ANodeSleepsUntilASimulatedTimeWithoutBeingSpun) {
  const auto node = std::make_shared<rclcpp::Node>("sleeper", simulated());
  simulate(5, [&] { return node->now().seconds() == 5; });
  auto slept =
      std::async(std::launch::async, [&] { return node->get_clock()->sleep_until(rclcpp::Time(15, 0, RCL_ROS_TIME)); });
  simulate(20, [&] { return slept.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  EXPECT_TRUE(slept.get());
  EXPECT_EQ(node->now(), rclcpp::Time(20, 0, RCL_ROS_TIME));

  ASSERT_TRUE(node->set_parameter(rclcpp::Parameter("use_sim_time", false)).successful);
  EXPECT_FALSE(node->get_clock()->ros_time_is_active());
  EXPECT_EQ(simulator_->count_subscribers("/clock"), 0U);
  ASSERT_TRUE(node->set_parameter(rclcpp::Parameter("use_sim_time", true)).successful);
  simulate(30, [&] { return node->now().seconds() == 30; });
}

TEST_F(TimeSource, WithoutAThreadTheNodeIsToBeSpun) {
  const auto node = std::make_shared<rclcpp::Node>("spun", simulated().use_clock_thread(false));
  const auto beside = std::make_shared<rclcpp::Node>("beside", simulated());
  simulate(5, [&] { return beside->now().seconds() == 5; });
  EXPECT_EQ(node->now().nanoseconds(), 0);
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  simulate(6, [&] {
    executor.spin_some();
    return node->now().seconds() == 6;
  });
}

TEST_F(TimeSource, HasAThreadWhileTimeIsSimulated) {
  const auto node = std::make_shared<rclcpp::Node>("node");
  rclcpp::TimeSource source(node);
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  source.attachClock(clock);
  EXPECT_TRUE(source.get_use_clock_thread());
  EXPECT_FALSE(source.clock_thread_is_joinable());
  node->set_parameter(rclcpp::Parameter("use_sim_time", true));
  EXPECT_TRUE(source.clock_thread_is_joinable());
  simulate(7, [&] { return clock->now().seconds() == 7; });
  source.detachNode();
  EXPECT_FALSE(source.clock_thread_is_joinable());
  EXPECT_FALSE(clock->ros_time_is_active());

  source.set_use_clock_thread(false);
  source.attachNode(node->get_node_base_interface(), node->get_node_topics_interface(),
                    node->get_node_graph_interface(), node->get_node_services_interface(),
                    node->get_node_logging_interface(), node->get_node_clock_interface(),
                    node->get_node_parameters_interface());
  EXPECT_TRUE(clock->ros_time_is_active());
  EXPECT_FALSE(source.clock_thread_is_joinable());
}

}  // namespace
