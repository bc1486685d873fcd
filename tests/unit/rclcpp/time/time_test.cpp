// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <rclcpp/clock.hpp>
#include <rclcpp/duration.hpp>
#include <rclcpp/qos.hpp>
#include <rclcpp/rate.hpp>
#include <rclcpp/time.hpp>

using rclcpp::Duration;
using rclcpp::Time;

namespace {

constexpr int64_t kMax = std::numeric_limits<int64_t>::max();

TEST(Duration, ConvertsToAndFromChronoSecondsAndMessages) {
  EXPECT_EQ(Duration(std::chrono::milliseconds(1500)).nanoseconds(), 1'500'000'000);
  EXPECT_EQ(Duration::from_seconds(-0.5).nanoseconds(), -500'000'000);
  EXPECT_DOUBLE_EQ(Duration(1, 500'000'000).seconds(), 1.5);
  EXPECT_EQ(Duration(2, 0).to_chrono<std::chrono::milliseconds>(), std::chrono::milliseconds(2000));

  const builtin_interfaces::msg::Duration message = Duration::from_seconds(-0.25);
  EXPECT_EQ(message.sec, -1);
  EXPECT_EQ(message.nanosec, 750'000'000u);
  EXPECT_EQ(Duration(message), Duration::from_seconds(-0.25));
}

TEST(Duration, RefusesOverflow) {
  EXPECT_THROW(Duration::from_nanoseconds(kMax) + Duration(0, 1), std::overflow_error);
  EXPECT_THROW(Duration::from_nanoseconds(-kMax) - Duration(2, 0), std::underflow_error);
  EXPECT_THROW(Duration::from_nanoseconds(kMax) * 2.0, std::overflow_error);
  EXPECT_THROW(Duration::from_nanoseconds(kMax) * -2.0, std::underflow_error);
  EXPECT_THROW(Duration(1, 0) * std::numeric_limits<double>::quiet_NaN(), std::runtime_error);
  EXPECT_THROW(Duration(1, 0) * std::numeric_limits<double>::infinity(), std::runtime_error);
  EXPECT_EQ(Duration(1, 0) * 2.5, Duration(2, 500'000'000));
}

TEST(Duration, RefusesANegativeRmwTime) {
  EXPECT_THROW(Duration(-1, 0).to_rmw_time(), std::runtime_error);
  EXPECT_EQ(Duration(3, 4).to_rmw_time().sec, 3u);
  EXPECT_EQ(Duration(3, 4).to_rmw_time().nsec, 4u);
}

TEST(Time, CalculatesOnOneClock) {
  const Time start(10, 5);
  EXPECT_EQ((start + Duration(1, 0)).nanoseconds(), 11'000'000'005);
  EXPECT_EQ(start + Duration(1, 0) - start, Duration(1, 0));
  EXPECT_TRUE(start < start + Duration(0, 1));
  EXPECT_TRUE(start >= start);
  const builtin_interfaces::msg::Time message = start;
  EXPECT_EQ(message.sec, 10);
  EXPECT_EQ(message.nanosec, 5u);
}

TEST(Time, RefusesNegativeSecondsAndOverflow) {
  EXPECT_THROW(Time(-1, 0), std::runtime_error);
  builtin_interfaces::msg::Time message;
  message.sec = -1;
  EXPECT_THROW((void)Time(message), std::runtime_error);
  EXPECT_THROW(Time(kMax) + Duration(0, 1), std::overflow_error);
  try {
    (void)(Time(-kMax) - Duration(2, 0));
    FAIL() << "no exception";
  } catch (const std::underflow_error& error) {
    EXPECT_STREQ(error.what(), "time subtraction leads to int64_t underflow");
  }
}

TEST(Time, IsNegativeAfterArithmetic) {
  const Time before = Time(2, 0) - Duration(5, 0);
  EXPECT_EQ(before.nanoseconds(), -3'000'000'000);
  EXPECT_EQ(Time(-1).nanoseconds(), -1);
  const builtin_interfaces::msg::Time message = before - Duration(0, 1);
  EXPECT_EQ(message.sec, -4);
  EXPECT_EQ(message.nanosec, 999'999'999u);
}

TEST(Time, BecomesTheLargestMessageIfItIsLarger) {
  const builtin_interfaces::msg::Time last = Time::max(RCL_ROS_TIME);
  EXPECT_EQ(last.sec, std::numeric_limits<int32_t>::max());
  EXPECT_EQ(last.nanosec, 999'999'999u);
  EXPECT_EQ(Time::max(RCL_ROS_TIME).get_clock_type(), RCL_ROS_TIME);
  const builtin_interfaces::msg::Time later = Time::max() + Duration(0, 1);
  EXPECT_EQ(later.sec, std::numeric_limits<int32_t>::max());
  EXPECT_EQ(later.nanosec, std::numeric_limits<uint32_t>::max());
  const builtin_interfaces::msg::Duration longest = Duration::max();
  EXPECT_EQ(longest.sec, std::numeric_limits<int32_t>::max());
  EXPECT_EQ(longest.nanosec, 999'999'999u);
  const builtin_interfaces::msg::Duration smallest = Duration::from_nanoseconds(-kMax);
  EXPECT_EQ(smallest.sec, std::numeric_limits<int32_t>::min());
  EXPECT_EQ(smallest.nanosec, 0u);
}

TEST(Time, ThatOfAMessageTakesPartInArithmetic) {
  builtin_interfaces::msg::Time message;
  message.sec = 2;
  EXPECT_EQ((message + Duration(1, 5)).nanosec, 5u);
  EXPECT_EQ((message - Duration(5, 0)).sec, -3);
  message.sec = -1;
  EXPECT_THROW((void)(message + Duration(1, 0)), std::runtime_error);
}

TEST(Time, RefusesToMixClocks) {
  const Time system(1, 0, RCL_SYSTEM_TIME);
  const Time steady(1, 0, RCL_STEADY_TIME);
  EXPECT_THROW((void)(system == steady), std::runtime_error);
  EXPECT_THROW((void)(system < steady), std::runtime_error);
  try {
    (void)(system - steady);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "can't subtract times with different time sources [2 != 3]");
  }
}

TEST(Clock, GoesForwardAndKnowsItsType) {
  rclcpp::Clock clock(RCL_STEADY_TIME);
  const Time before = clock.now();
  EXPECT_GE(clock.now(), before);
  EXPECT_EQ(before.get_clock_type(), RCL_STEADY_TIME);
  EXPECT_TRUE(clock.started());
  EXPECT_FALSE(rclcpp::Clock(RCL_ROS_TIME).ros_time_is_active());
}

TEST(Clock, RefusesToSleepWithoutAValidContext) {
  rclcpp::Clock clock(RCL_STEADY_TIME);
  EXPECT_THROW(clock.sleep_for(Duration(0, 1)), std::runtime_error);
}

TEST(Rate, RefusesRatesAndPeriodsThatAreNotPositive) {
  EXPECT_THROW(rclcpp::WallRate(0.0), std::invalid_argument);
  EXPECT_THROW(rclcpp::WallRate(Duration(-1, 0)), std::invalid_argument);
  EXPECT_EQ(rclcpp::WallRate(4.0).period(), std::chrono::milliseconds(250));
}

TEST(QoS, HasTheDefaultsOfEachProfile) {
  const rclcpp::QoS qos(7);
  EXPECT_EQ(qos.history(), rclcpp::HistoryPolicy::KeepLast);
  EXPECT_EQ(qos.depth(), 7u);
  EXPECT_EQ(qos.reliability(), rclcpp::ReliabilityPolicy::Reliable);
  EXPECT_EQ(qos.durability(), rclcpp::DurabilityPolicy::Volatile);

  EXPECT_EQ(rclcpp::SensorDataQoS().reliability(), rclcpp::ReliabilityPolicy::BestEffort);
  EXPECT_EQ(rclcpp::SensorDataQoS().depth(), 5u);
  EXPECT_EQ(rclcpp::ClockQoS().depth(), 1u);
  EXPECT_EQ(rclcpp::ClockQoS().reliability(), rclcpp::ReliabilityPolicy::BestEffort);
  EXPECT_EQ(rclcpp::ParameterEventsQoS().depth(), 1000u);
  EXPECT_EQ(rclcpp::RosoutQoS().durability(), rclcpp::DurabilityPolicy::TransientLocal);
  EXPECT_EQ(rclcpp::SystemDefaultsQoS().reliability(), rclcpp::ReliabilityPolicy::SystemDefault);
  EXPECT_EQ(rclcpp::BestAvailableQoS().durability(), rclcpp::DurabilityPolicy::BestAvailable);
}

TEST(QoS, SettersChain) {
  const rclcpp::QoS qos =
      rclcpp::QoS(1).keep_all().best_effort().transient_local().deadline(Duration(1, 0)).lifespan(Duration(2, 0));
  EXPECT_EQ(qos.history(), rclcpp::HistoryPolicy::KeepAll);
  EXPECT_EQ(qos.reliability(), rclcpp::ReliabilityPolicy::BestEffort);
  EXPECT_EQ(qos.durability(), rclcpp::DurabilityPolicy::TransientLocal);
  EXPECT_EQ(qos.deadline(), Duration(1, 0));
  EXPECT_EQ(qos.lifespan(), Duration(2, 0));
  EXPECT_NE(qos, rclcpp::QoS(1));
  EXPECT_EQ(rclcpp::QoS(rclcpp::KeepLast(3)), rclcpp::QoS(3));
}

}  // namespace
