// SPDX-License-Identifier: Apache-2.0
// Every callback that is ready gets its turn, whatever kind of entity the others are of.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <vector>

#include "tests/support/overtaking.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::CallbackGroupType;
using rclcpp::experimental::executors::EventsExecutor;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using std_msgs::msg::UInt64;
using test_support::overtaking;

namespace {

constexpr std::size_t kTurns = 300;

// So long that the other threads look for work meanwhile.
void work(std::chrono::microseconds time = std::chrono::microseconds(300)) {
  const auto end = steady_clock::now() + time;
  while (steady_clock::now() < end) {
  }
}

class FairnessTest : public RosTest {
 protected:
  // Of the one exclusive group, so it needs no lock. Ends the spinning after the last turn.
  void takes_a_turn(const std::string& name) {
    turns_.push_back(name);
    work();
    if (turns_.size() >= kTurns) {
      executor_->cancel();
    }
  }
  // A timer that is always due.
  void add_timer(const std::string& name) { add_timer(name, group_); }
  void add_timer(const std::string& name, const rclcpp::CallbackGroup::SharedPtr& group) {
    timers_.push_back(node_->create_wall_timer(
        milliseconds(0), [this, name] { takes_a_turn(name); }, group));
    always_ready_.push_back(name);
  }
  // A subscription that gets a message for each one that it takes, and has a hundred to begin with.
  void add_subscription(const std::string& name) {
    const auto publisher = node_->create_publisher<UInt64>(name, 200);
    rclcpp::SubscriptionOptions options;
    options.callback_group = group_;
    subscriptions_.push_back(node_->create_subscription<UInt64>(
        name, 200,
        [this, name, publisher](const UInt64& message) {
          publisher->publish(message);
          takes_a_turn(name);
        },
        options));
    ASSERT_TRUE(spin_until(*executor_, [&] { return publisher->get_subscription_count() == 1; }));
    for (int i = 0; i < 100; ++i) {
      publisher->publish(UInt64());
    }
  }
  void spin_and_expect_fairness(const std::shared_ptr<rclcpp::Executor>& executor) {
    executor_->remove_node(node_);
    executor_ = executor;
    executor_->add_node(node_);
    turns_.clear();
    executor_->spin();
    ASSERT_GE(turns_.size(), kTurns);
    for (const std::string& name : always_ready_) {
      EXPECT_EQ(overtaking(turns_, name).times, 0) << name;
    }
  }
  void spin_with_threads_and_expect_fairness() {
    for (const std::size_t threads : {1, 2, 4}) {
      SCOPED_TRACE(std::to_string(threads) + " threads");
      {
        SCOPED_TRACE("MultiThreadedExecutor");
        spin_and_expect_fairness(
            std::make_shared<rclcpp::executors::MultiThreadedExecutor>(rclcpp::ExecutorOptions(), threads));
      }
      SCOPED_TRACE("EventsCBGExecutor");
      spin_and_expect_fairness(
          std::make_shared<rclcpp::executors::EventsCBGExecutor>(rclcpp::ExecutorOptions(), threads));
    }
    SCOPED_TRACE("EventsExecutor");
    spin_and_expect_fairness(std::make_shared<EventsExecutor>());
  }

  const rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  const rclcpp::CallbackGroup::SharedPtr group_ = node_->create_callback_group(CallbackGroupType::MutuallyExclusive);
  std::shared_ptr<rclcpp::Executor> executor_ = [this] {
    auto executor = std::make_shared<rclcpp::executors::SingleThreadedExecutor>();
    executor->add_node(node_);
    return executor;
  }();
  std::vector<rclcpp::TimerBase::SharedPtr> timers_;
  std::vector<rclcpp::Subscription<UInt64>::SharedPtr> subscriptions_;
  std::vector<std::string> always_ready_;
  std::vector<std::string> turns_;
};

TEST_F(FairnessTest, OfTimersOfAnExclusiveGroup) {
  for (const char* name : {"a", "b", "c"}) {
    add_timer(name);
  }
  spin_with_threads_and_expect_fairness();
}

TEST_F(FairnessTest, OfSubscriptionsAndATimerOfAnExclusiveGroup) {
  add_subscription("left");
  add_subscription("right");
  add_timer("a");
  spin_with_threads_and_expect_fairness();
}

// A reentrant group has something to do at any time, so that there is always another wait.
TEST_F(FairnessTest, OfAnExclusiveGroupBesideABusyOne) {
  add_timer("a");
  add_timer("b");
  const auto reentrant = node_->create_callback_group(CallbackGroupType::Reentrant);
  const auto busy = node_->create_wall_timer(
      milliseconds(0), [] {}, reentrant);
  spin_with_threads_and_expect_fairness();
}

TEST_F(FairnessTest, OfAGroupWithManyEntitiesBesideOneWithFewInOneThread) {
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    add_timer(name);
  }
  const auto other = node_->create_callback_group(CallbackGroupType::MutuallyExclusive);
  add_timer("other", other);
  spin_and_expect_fairness(std::make_shared<rclcpp::executors::SingleThreadedExecutor>());
  spin_and_expect_fairness(std::make_shared<rclcpp::executors::EventsCBGExecutor>(rclcpp::ExecutorOptions(), 1));
  spin_and_expect_fairness(std::make_shared<EventsExecutor>());
}

TEST_F(FairnessTest, OfTimersBesideManySubscriptions) {
  for (const char* name : {"left", "right", "front", "back", "top"}) {
    add_subscription(name);
    always_ready_.emplace_back(name);
  }
  add_timer("a");
  add_timer("b");
  spin_with_threads_and_expect_fairness();
}

TEST_F(FairnessTest, OfAnExecutorThatHasNoTimeForAllOfThem) {
  for (const char* name : {"a", "b", "c"}) {
    timers_.push_back(node_->create_wall_timer(
        milliseconds(0),
        [this, name] {
          turns_.push_back(name);
          work(milliseconds(1));
        },
        group_));
  }
  // Each of them leaves something that it had no time for.
  for (const std::shared_ptr<rclcpp::Executor>& executor : std::vector<std::shared_ptr<rclcpp::Executor>>{
           std::make_shared<rclcpp::executors::SingleThreadedExecutor>(),
           std::make_shared<rclcpp::executors::SingleThreadedExecutor>(),
           std::make_shared<rclcpp::executors::MultiThreadedExecutor>(),
           std::make_shared<rclcpp::executors::EventsCBGExecutor>(), std::make_shared<EventsExecutor>()}) {
    executor_->remove_node(node_);
    executor_ = executor;
    executor_->add_node(node_);
    turns_.clear();
    while (turns_.size() < 30) {
      executor_->spin_some(milliseconds(1));
    }
    for (const char* name : {"a", "b", "c"}) {
      EXPECT_EQ(overtaking(turns_, name).times, 0) << name;
      EXPECT_GE(std::count(turns_.begin(), turns_.end(), name), 9) << name;
    }
  }
}

}  // namespace
