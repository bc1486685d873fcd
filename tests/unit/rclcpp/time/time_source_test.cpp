// SPDX-License-Identifier: Apache-2.0
// Simulated time arrives even if nobody spins the node.
#include <gmock/gmock.h>

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

TEST_F(TimeSource, TheQualityOfServiceOfTheClockCanBeOverridden) {
  const std::string prefix = "qos_overrides./clock.subscription.";
  const auto names_of = [&](const rclcpp::Node& node) {
    return node.list_parameters({"qos_overrides./clock"}, 0).names;
  };
  const auto options = rclcpp::NodeOptions().parameter_overrides({rclcpp::Parameter(prefix + "depth", 7)});
  const auto node = std::make_shared<rclcpp::Node>("late", options);
  EXPECT_THAT(names_of(*node), testing::IsEmpty());
  // The subscription is made while the parameter is set.
  ASSERT_TRUE(node->set_parameter(rclcpp::Parameter("use_sim_time", true)).successful);
  EXPECT_THAT(names_of(*node), testing::UnorderedElementsAre(prefix + "depth", prefix + "durability",
                                                             prefix + "history", prefix + "reliability"));
  const auto subscriptions = node->get_subscriptions_info_by_topic("/clock");
  ASSERT_EQ(subscriptions.size(), 1U);
  EXPECT_EQ(subscriptions[0].qos_profile().depth(), 7U);
  EXPECT_EQ(subscriptions[0].qos_profile().reliability(), rclcpp::ReliabilityPolicy::BestEffort);

  const auto early = std::make_shared<rclcpp::Node>("early", simulated());
  EXPECT_EQ(early->get_parameter(prefix + "depth").as_int(), 1);
  EXPECT_EQ(early->get_parameter(prefix + "reliability").as_string(), "best_effort");
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

// Sleeps in another thread, until `until` on the clock of `node`.
std::future<bool> sleeping(const rclcpp::Node::SharedPtr& node, const rclcpp::Time& until) {
  return std::async(std::launch::async, [clock = node->get_clock(), until] { return clock->sleep_until(until); });
}

bool is_ready(const std::future<bool>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

constexpr int32_t kHour = 3600;  // seconds

TEST_F(TimeSource, AnHourOfSimulatedTimeIsSleptAsFastAsItPasses) {
  const auto node = std::make_shared<rclcpp::Node>("sleeper", simulated());
  simulate(5, [&] { return node->now().seconds() == 5; });
  auto slept = std::async(std::launch::async, [&] { return node->get_clock()->sleep_for(rclcpp::Duration(kHour, 0)); });
  // The thread may look at the clock late, hence more than an hour.
  for (int32_t now = 5 + kHour; !is_ready(slept); now += kHour) {
    simulate(now, [&] { return is_ready(slept) || node->now().seconds() == now; });
  }
  EXPECT_TRUE(slept.get());
}

TEST_F(TimeSource, ASleepEndsWhenSimulatedTimeBeginsOrEnds) {
  const auto node = std::make_shared<rclcpp::Node>("switched");
  auto slept = sleeping(node, node->now() + rclcpp::Duration(kHour, 0));
  bool on = false;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!is_ready(slept)) {  // the first change may come before the sleep
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    on = !on;
    ASSERT_TRUE(node->set_parameter(rclcpp::Parameter("use_sim_time", on)).successful);
    slept.wait_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(slept.get());
}

TEST_F(TimeSource, ASleepIsCancelledNowOrWhenItBegins) {
  for (const bool simulate_time : {false, true}) {
    const auto node = std::make_shared<rclcpp::Node>("cancelled", simulate_time ? simulated() : rclcpp::NodeOptions());
    auto slept = sleeping(node, node->now() + rclcpp::Duration(kHour, 0));
    node->get_clock()->cancel_sleep_or_wait();
    EXPECT_FALSE(slept.get());
  }
}

TEST_F(TimeSource, TheEndOfTheContextEndsASleep) {
  const auto node = std::make_shared<rclcpp::Node>("sleeper", simulated());
  rclcpp::Rate rate(1.0 / kHour, node->get_clock());
  auto slept = std::async(std::launch::async, [&] { return rate.sleep(); });
  rclcpp::shutdown();
  EXPECT_FALSE(slept.get());
  EXPECT_FALSE(rate.sleep()) << "a loop that has just seen ok() must not end with an exception";
}

TEST_F(TimeSource, ASteadyClockCannotBeSimulated) {
  const auto steady = rclcpp::NodeOptions().clock_type(RCL_STEADY_TIME);
  const auto node = std::make_shared<rclcpp::Node>("steady", steady);
  const auto result = node->set_parameter(rclcpp::Parameter("use_sim_time", true));
  EXPECT_FALSE(result.successful);
  EXPECT_EQ(result.reason, "use_sim_time parameter can't be true while clocks are not all of RCL_ROS_TIME type");
  try {
    rclcpp::Node("never", simulated().clock_type(RCL_STEADY_TIME));
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "ros_time_active_ can't be true while clock is not of RCL_ROS_TIME type");
  }
}

}  // namespace
