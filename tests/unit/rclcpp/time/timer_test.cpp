// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <rosgraph_msgs/msg/clock.hpp>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using std::chrono::milliseconds;
using std::chrono::steady_clock;

namespace {

class TimerTest : public RosTest {
 protected:
  TimerTest() { executor_.add_node(node_); }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(TimerTest, FiresOncePerPeriodAndNotBefore) {
  constexpr milliseconds kPeriod{20};
  std::vector<steady_clock::time_point> calls;
  const auto start = steady_clock::now();
  auto timer = node_->create_wall_timer(kPeriod, [&calls] { calls.push_back(steady_clock::now()); });
  ASSERT_TRUE(spin_until(executor_, [&] { return calls.size() == 3; }));
  for (size_t i = 0; i < calls.size(); ++i) {
    EXPECT_GE(calls[i] - start, (i + 1) * kPeriod);
  }
  EXPECT_TRUE(timer->is_steady());
}

TEST_F(TimerTest, TakesCallbacksWithTheTimerItself) {
  int calls = 0;
  auto timer = node_->create_wall_timer(milliseconds(1), [&calls](rclcpp::TimerBase& self) {
    ++calls;
    self.cancel();
  });
  ASSERT_TRUE(spin_until(executor_, [&] { return timer->is_canceled(); }));
  executor_.spin_once(milliseconds(20));
  EXPECT_EQ(calls, 1);
}

TEST_F(TimerTest, TellsCallbacksWhenTheyWereDue) {
  std::vector<rclcpp::TimerInfo> calls;
  auto timer =
      node_->create_wall_timer(milliseconds(2), [&calls](const rclcpp::TimerInfo& info) { calls.push_back(info); });
  ASSERT_TRUE(spin_until(executor_, [&] { return calls.size() == 2; }));
  for (const rclcpp::TimerInfo& call : calls) {
    EXPECT_GE(call.actual_call_time, call.expected_call_time);
    EXPECT_EQ(call.expected_call_time.get_clock_type(), RCL_STEADY_TIME);
  }
  const auto between = calls[1].expected_call_time - calls[0].expected_call_time;
  EXPECT_EQ(between.nanoseconds() % 2'000'000, 0);
  EXPECT_GT(between.nanoseconds(), 0);
}

TEST_F(TimerTest, IsExecutedByHandWithOrWithoutWhatACallTold) {
  std::vector<rclcpp::TimerInfo> calls;
  auto timer = node_->create_wall_timer(std::chrono::hours(1),
                                        [&calls](const rclcpp::TimerInfo& info) { calls.push_back(info); });
  const std::shared_ptr<void> data = timer->call();
  ASSERT_NE(data, nullptr);
  timer->execute_callback(data);
  timer->execute_callback();
  ASSERT_EQ(calls.size(), 2u);
  EXPECT_GT(calls[0].expected_call_time, calls[0].actual_call_time);
  EXPECT_EQ(calls[1].expected_call_time, calls[1].actual_call_time);
  timer->cancel();
  EXPECT_EQ(timer->call(), nullptr);
}

TEST_F(TimerTest, OfManyEachFiresInItsTurn) {
  std::vector<int> calls;
  std::vector<rclcpp::TimerBase::SharedPtr> timers;
  for (int i = 50; i > 0; --i) {
    timers.push_back(node_->create_wall_timer(milliseconds(i) * 2, [&calls, &timers, i] {
      calls.push_back(i);
      timers[static_cast<size_t>(50 - i)]->cancel();
    }));
  }
  auto idle = node_->create_wall_timer(std::chrono::hours(1), [] {});
  ASSERT_TRUE(spin_until(executor_, [&] { return calls.size() == 50; }));
  EXPECT_TRUE(std::is_permutation(calls.begin(), calls.end(),
                                  [] {
                                    std::vector<int> all(50);
                                    std::iota(all.begin(), all.end(), 1);
                                    return all;
                                  }()
                                      .begin()));
  calls.clear();
  timers.front()->reset();
  EXPECT_TRUE(spin_until(executor_, [&] { return calls == std::vector<int>{50}; }));
}

TEST_F(TimerTest, ACanceledTimerWaitsForItsReset) {
  int calls = 0;
  auto timer = node_->create_wall_timer(milliseconds(1), [&calls] { ++calls; });
  timer->cancel();
  EXPECT_EQ(timer->time_until_trigger(), std::chrono::nanoseconds::max());
  executor_.spin_once(milliseconds(20));
  EXPECT_EQ(calls, 0);
  EXPECT_FALSE(timer->is_ready());
  timer->reset();
  EXPECT_TRUE(spin_until(executor_, [&] { return calls > 0; }));
}

TEST_F(TimerTest, WithoutAutostartATimerWaitsForItsReset) {
  auto timer = node_->create_wall_timer(
      milliseconds(1), [] {}, nullptr, false);
  EXPECT_TRUE(timer->is_canceled());
  timer->reset();
  EXPECT_FALSE(timer->is_canceled());
}

TEST_F(TimerTest, RefusesBadPeriods) {
  EXPECT_THROW(node_->create_wall_timer(milliseconds(-1), [] {}), std::invalid_argument);
  EXPECT_THROW(node_->create_wall_timer(std::chrono::hours(24 * 365 * 300), [] {}), std::invalid_argument);
}

TEST_F(TimerTest, DroppedTimersDoNotFire) {
  int calls = 0;
  auto timer = node_->create_wall_timer(milliseconds(1), [&calls] { ++calls; });
  timer.reset();
  executor_.spin_once(milliseconds(20));
  EXPECT_EQ(calls, 0);
}

TEST_F(TimerTest, FollowsSimulatedTime) {
  auto simulator = std::make_shared<rclcpp::Node>("simulator");
  auto clock = simulator->create_publisher<rosgraph_msgs::msg::Clock>("/clock", rclcpp::ClockQoS());
  ASSERT_TRUE(node_->set_parameter(rclcpp::Parameter("use_sim_time", true)).successful);
  EXPECT_TRUE(node_->get_clock()->ros_time_is_active());
  ASSERT_TRUE(spin_until(executor_, [&] { return clock->get_subscription_count() == 1; }));

  int calls = 0;
  auto timer = node_->create_timer(std::chrono::seconds(10), [&calls] { ++calls; });
  const auto set_time = [&](int32_t seconds) {
    rosgraph_msgs::msg::Clock message;
    message.clock.sec = seconds;
    clock->publish(message);
    ASSERT_TRUE(spin_until(executor_, [&] { return node_->now() == rclcpp::Time(seconds, 0, RCL_ROS_TIME); }));
  };
  set_time(5);
  EXPECT_EQ(calls, 0);
  set_time(11);
  EXPECT_TRUE(spin_until(executor_, [&] { return calls == 1; }));

  ASSERT_TRUE(node_->set_parameter(rclcpp::Parameter("use_sim_time", false)).successful);
  EXPECT_FALSE(node_->get_clock()->ros_time_is_active());
}

}  // namespace
