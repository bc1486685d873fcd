// SPDX-License-Identifier: Apache-2.0
// Waits for a time of a clock, or for a condition.
#include <future>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

class ClockConditionalVariable : public RosTest {};

TEST_F(ClockConditionalVariable, AThreadWaitsForATimeOfAClockOrForACondition) {
  for (const rcl_clock_type_t type : {RCL_SYSTEM_TIME, RCL_STEADY_TIME, RCL_ROS_TIME}) {
    const auto clock = std::make_shared<rclcpp::Clock>(type);
    rclcpp::ClockConditionalVariable condition(clock);
    bool is_set = false;
    std::thread thread([&] {
      {
        const std::lock_guard lock(condition.mutex());
        is_set = true;
      }
      condition.notify_one();
    });
    {
      std::unique_lock lock(condition.mutex());
      EXPECT_TRUE(condition.wait_until(lock, clock->now() + rclcpp::Duration(kPatience), [&] { return is_set; }));
      EXPECT_TRUE(is_set);
      const rclcpp::Time soon = clock->now() + rclcpp::Duration(milliseconds(1));
      EXPECT_TRUE(condition.wait_until(lock, soon, [] { return false; }));
      EXPECT_GE(clock->now(), soon);
    }
    thread.join();
    std::mutex other;
    std::unique_lock lock(other);
    EXPECT_EQ(error_of<std::runtime_error>([&] { condition.wait_until(lock, clock->now(), [] { return true; }); }),
              "ClockConditionalVariable::wait_until: Internal error, given lock does not use mutex returned by "
              "this->mutex()");
  }
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  EXPECT_EQ(error_of<std::runtime_error>([&] { rclcpp::ClockConditionalVariable(clock, nullptr); }),
            "context cannot be slept with because it's invalid");
}

TEST_F(ClockConditionalVariable, ASimulatedClockEndsAWaitWhenItReachesTheTime) {
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  const auto set_time = [&clock](int64_t time) {
    const std::lock_guard lock(clock->get_clock_mutex());
    ASSERT_EQ(rcl_set_ros_time_override(clock->get_clock_handle(), time), RCL_RET_OK);
  };
  {
    const std::lock_guard lock(clock->get_clock_mutex());
    ASSERT_EQ(rcl_enable_ros_time_override(clock->get_clock_handle()), RCL_RET_OK);
  }
  set_time(100);
  rclcpp::ClockWaiter waiter(clock);
  std::mutex mutex;
  std::promise<void> begun;
  std::thread thread([&] {
    std::unique_lock lock(mutex);
    waiter.wait_until(lock, rclcpp::Time(int64_t{200}, RCL_ROS_TIME), [&, told = false]() mutable {
      if (!std::exchange(told, true)) {
        begun.set_value();
      }
      return false;
    });
    EXPECT_GE(clock->now().nanoseconds(), 200);
  });
  begun.get_future().wait();
  set_time(150);
  set_time(200);
  thread.join();
}

TEST_F(ClockConditionalVariable, TheEndOfTheContextEndsAWait) {
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  rclcpp::ClockConditionalVariable condition(clock);
  std::thread thread([] { rclcpp::shutdown(); });
  {
    std::unique_lock lock(condition.mutex());
    EXPECT_TRUE(condition.wait_until(lock, clock->now() + rclcpp::Duration::max() * 0.5, [] { return false; }));
  }
  thread.join();
}

}  // namespace
