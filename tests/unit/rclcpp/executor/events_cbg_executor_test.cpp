// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <std_msgs/msg/u_int64.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::CallbackGroupType;
using rclcpp::executors::EventsCBGExecutor;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std_msgs::msg::UInt64;

namespace {

UInt64 number(uint64_t data) {
  UInt64 message;
  message.data = data;
  return message;
}

rclcpp::SubscriptionOptions in(const rclcpp::CallbackGroup::SharedPtr& group) {
  rclcpp::SubscriptionOptions options;
  options.callback_group = group;
  return options;
}

// Ready when its guard condition is triggered.
class Bell : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override { condition.add_to_wait_set(wait_set); }
  bool is_ready(const rcl_wait_set_t&) override { return true; }
  std::shared_ptr<void> take_data() override { return nullptr; }
  std::shared_ptr<void> take_data_by_entity_id(size_t id) override { return std::make_shared<size_t>(id); }
  void execute(const std::shared_ptr<void>& data) override { ids.push_back(*std::static_pointer_cast<size_t>(data)); }
  void set_on_ready_callback(std::function<void(size_t, int)> callback) override {
    condition.set_on_trigger_callback([callback](size_t count) {
      callback(count, 7);
      callback(1, 8);
    });
  }
  void clear_on_ready_callback() override { condition.set_on_trigger_callback(nullptr); }

  rclcpp::GuardCondition condition;
  std::vector<size_t> ids;
};

class EventsCbgExecutorTest : public RosTest {
 protected:
  EventsCbgExecutorTest() { executor_.add_node(node_); }

  rclcpp::CallbackGroup::SharedPtr exclusive() {
    return node_->create_callback_group(CallbackGroupType::MutuallyExclusive);
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  EventsCBGExecutor executor_{rclcpp::ExecutorOptions(), 4};
};

// Two groups, each with two subscriptions that always have a message, a timer that is always due, and a counter that
// has no lock.
TEST_F(EventsCbgExecutorTest, ExclusiveGroupsKeepTheirOrderUnderLoad) {
  constexpr int kCalls = 2000;
  struct OfGroup {
    rclcpp::CallbackGroup::SharedPtr group;
    int calls = 0;
    std::atomic<int> running{0};
    std::vector<uint64_t> last = {0, 0};
  };
  OfGroup of_groups[2];
  std::atomic<bool> overlapped{false};
  std::atomic<bool> out_of_order{false};
  std::atomic<int> finished{0};
  std::vector<std::shared_ptr<void>> kept;
  const auto called = [&](OfGroup& of_group) {
    overlapped = overlapped || ++of_group.running != 1;
    if (++of_group.calls == kCalls && ++finished == 2) {
      executor_.cancel();
    }
    --of_group.running;
  };
  int topics = 0;
  for (OfGroup& of_group : of_groups) {
    of_group.group = exclusive();
    for (uint64_t& last : of_group.last) {
      const std::string topic = "topic" + std::to_string(topics++);
      const auto publisher = node_->create_publisher<UInt64>(topic, 10);
      const auto receive = [&, publisher](const UInt64& message) {
        out_of_order = out_of_order || message.data != last + 1;
        last = message.data;
        publisher->publish(number(last + 1));
        called(of_group);
      };
      kept.push_back(node_->create_subscription<UInt64>(topic, 10, receive, in(of_group.group)));
      ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
      publisher->publish(number(1));
    }
    kept.push_back(node_->create_wall_timer(
        milliseconds(0), [&] { called(of_group); }, of_group.group));
  }
  executor_.spin();
  EXPECT_EQ(finished, 2);
  EXPECT_FALSE(overlapped);
  EXPECT_FALSE(out_of_order);
}

TEST_F(EventsCbgExecutorTest, MixesTimersOfAllClocks) {
  const auto simulated = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  ASSERT_EQ(rcl_enable_ros_time_override(simulated->get_clock_handle()), RCL_RET_OK);
  std::atomic<int> of_simulation{0};
  std::atomic<int> of_system{0};
  std::atomic<int> steady{0};
  auto first = rclcpp::create_timer(node_, simulated, rclcpp::Duration(10, 0), [&] { ++of_simulation; });
  auto second = rclcpp::create_timer(node_, std::make_shared<rclcpp::Clock>(RCL_SYSTEM_TIME),
                                     rclcpp::Duration(milliseconds(1)), [&] { ++of_system; });
  auto third = node_->create_wall_timer(milliseconds(1), [&] { ++steady; });
  ASSERT_TRUE(spin_until(executor_, [&] { return of_system > 2 && steady > 2; }));
  EXPECT_EQ(of_simulation, 0);
  second->cancel();
  third->cancel();
  std::thread thread([this] { executor_.spin(); });
  // A jump of simulated time wakes the executor.
  std::promise<void> called;
  auto fourth = rclcpp::create_timer(node_, simulated, rclcpp::Duration(20, 0), [&] { called.set_value(); });
  ASSERT_EQ(rcl_set_ros_time_override(simulated->get_clock_handle(), RCL_S_TO_NS(25)), RCL_RET_OK);
  EXPECT_EQ(called.get_future().wait_for(kPatience), std::future_status::ready);
  executor_.cancel();
  thread.join();
  EXPECT_EQ(of_simulation, 1);
}

TEST_F(EventsCbgExecutorTest, ExecutesManyTimersInTheOrderInWhichTheyAreDue) {
  constexpr int kTimers = 100;
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  ASSERT_EQ(rcl_enable_ros_time_override(clock->get_clock_handle()), RCL_RET_OK);
  std::vector<int> order;
  std::vector<rclcpp::TimerBase::SharedPtr> timers;
  for (int i = 0; i < kTimers; ++i) {
    const int place = (i * 37) % kTimers;  // each number once, out of order
    timers.push_back(rclcpp::create_timer(node_, clock, rclcpp::Duration::from_nanoseconds(place + 1),
                                          [&order, place] { order.push_back(place); }));
  }
  executor_.spin_some();
  EXPECT_TRUE(order.empty());
  ASSERT_EQ(rcl_set_ros_time_override(clock->get_clock_handle(), kTimers), RCL_RET_OK);
  executor_.spin_some();
  EXPECT_EQ(order.size(), kTimers);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

// A watchdog: a message puts the timer off that is already due and waits for its turn.
TEST_F(EventsCbgExecutorTest, ATimerThatIsResetBeforeItsTurnIsNotCalled) {
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  ASSERT_EQ(rcl_enable_ros_time_override(clock->get_clock_handle()), RCL_RET_OK);
  int barks = 0;
  int cancelled = 0;
  rclcpp::TimerBase::SharedPtr watchdog;
  rclcpp::TimerBase::SharedPtr third;
  auto first = rclcpp::create_timer(node_, clock, rclcpp::Duration(1, 0), [&] {
    watchdog->reset();
    third->cancel();
  });
  watchdog = rclcpp::create_timer(node_, clock, rclcpp::Duration(2, 0), [&] { ++barks; });
  third = rclcpp::create_timer(node_, clock, rclcpp::Duration(2, 0), [&] { ++cancelled; });
  executor_.spin_some();
  ASSERT_EQ(rcl_set_ros_time_override(clock->get_clock_handle(), RCL_S_TO_NS(3)), RCL_RET_OK);
  executor_.spin_some();
  EXPECT_EQ(barks, 0);
  first->cancel();
  ASSERT_EQ(rcl_set_ros_time_override(clock->get_clock_handle(), RCL_S_TO_NS(6)), RCL_RET_OK);
  executor_.spin_some();
  EXPECT_EQ(barks, 1);
  EXPECT_EQ(cancelled, 0);
}

TEST_F(EventsCbgExecutorTest, SpinSomeExecutesAllThatHasArrivedAndNothingLater) {
  std::vector<uint64_t> received;
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  auto subscription = node_->create_subscription<UInt64>("topic", 10, [&](const UInt64& message) {
    received.push_back(message.data);
    publisher->publish(number(message.data + 10));
    EXPECT_TRUE(publisher->wait_for_all_acked(kPatience));
  });
  executor_.spin_some();
  for (uint64_t i = 0; i < 3; ++i) {
    publisher->publish(number(i));
  }
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  EXPECT_TRUE(executor_.collect_and_execute_ready_events(nanoseconds(0), false));
  EXPECT_EQ(received, (std::vector<uint64_t>{0, 1, 2}));
  executor_.spin_some();
  EXPECT_EQ(received, (std::vector<uint64_t>{0, 1, 2, 10, 11, 12}));
  subscription.reset();
  executor_.spin_some();
  EXPECT_FALSE(executor_.collect_and_execute_ready_events(nanoseconds(0), true));
}

TEST_F(EventsCbgExecutorTest, WhatACancelledSpinLeavesIsExecutedByTheNextOne) {
  int received = 0;
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  auto subscription = node_->create_subscription<UInt64>("topic", 10, [&](const UInt64&) {
    ++received;
    executor_.cancel();
  });
  executor_.spin_some();
  for (uint64_t i = 0; i < 3; ++i) {
    publisher->publish(number(i));
  }
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  for (int i = 1; i <= 3; ++i) {
    executor_.spin();
    EXPECT_EQ(received, i);
  }
}

TEST_F(EventsCbgExecutorTest, AHandlerGetsTheExceptionsOfCallbacks) {
  std::atomic<int> calls{0};
  std::atomic<int> handled{0};
  auto timer = node_->create_wall_timer(milliseconds(0), [&] {
    if (++calls == 3) {
      executor_.cancel();
      return;
    }
    throw std::logic_error("mine");
  });
  executor_.spin([&](const std::exception& error) {
    EXPECT_STREQ(error.what(), "mine");
    ++handled;
  });
  EXPECT_EQ(handled, 2);
  calls = 0;
  EXPECT_THROW(executor_.spin([](const std::exception&) { throw std::runtime_error("the handler's"); }),
               std::runtime_error);
  EXPECT_FALSE(executor_.is_spinning());
}

TEST_F(EventsCbgExecutorTest, HearsWhichEntityOfAWaitableHadAnEvent) {
  const auto bell = std::make_shared<Bell>();
  bell->condition.trigger();  // reported when a listener is set
  bell->condition.trigger();
  node_->get_node_waitables_interface()->add_waitable(bell, nullptr);
  ASSERT_TRUE(spin_until(executor_, [&] { return bell->ids.size() == 3; }));
  EXPECT_EQ(bell->ids, (std::vector<size_t>{7, 7, 8}));
  std::thread ringing([&] { bell->condition.trigger(); });
  EXPECT_TRUE(spin_until(executor_, [&] { return bell->ids.size() == 5; }));
  ringing.join();
  executor_.spin_all(nanoseconds(0));
  EXPECT_EQ(bell->ids, (std::vector<size_t>{7, 7, 8, 7, 8}));
}

TEST_F(EventsCbgExecutorTest, RefusesWaitablesThatCannotTellAndServesTheOthers) {
  class Mute : public rclcpp::Waitable {
   public:
    void add_to_wait_set(rcl_wait_set_t&) override {}
    bool is_ready(const rcl_wait_set_t&) override { return false; }
    std::shared_ptr<void> take_data() override { return nullptr; }
    void execute(const std::shared_ptr<void>&) override {}
  };
  auto mute = std::make_shared<Mute>();
  node_->get_node_waitables_interface()->add_waitable(mute, nullptr);
  int calls = 0;
  auto timer = node_->create_wall_timer(milliseconds(0), [&calls] { ++calls; });
  EXPECT_THROW(executor_.spin_some(), std::runtime_error);
  executor_.spin_some();
  EXPECT_EQ(calls, 1);
}

// All threads but one are in a callback; the last one has to wake for the timer.
TEST_F(EventsCbgExecutorTest, ATimerIsCalledBesideBusyThreads) {
  executor_.remove_node(node_);
  EventsCBGExecutor executor(rclcpp::ExecutorOptions(), 3);
  executor.add_node(node_);
  std::promise<void> release;
  const auto released = release.get_future().share();
  std::atomic<int> busy{0};
  std::vector<std::shared_ptr<void>> kept;
  for (int i = 0; i < 2; ++i) {
    kept.push_back(exclusive());
    kept.push_back(node_->create_wall_timer(
        milliseconds(1),
        [&, released](rclcpp::TimerBase& self) {
          self.cancel();
          ++busy;
          released.wait();
        },
        std::static_pointer_cast<rclcpp::CallbackGroup>(kept.back())));
  }
  int ticks = 0;
  std::promise<void> ticked;
  kept.push_back(exclusive());
  auto timer = node_->create_wall_timer(
      milliseconds(2),
      [&] {
        if (busy == 2 && ++ticks == 5) {
          ticked.set_value();
        }
      },
      std::static_pointer_cast<rclcpp::CallbackGroup>(kept.back()));
  std::thread thread([&executor] { executor.spin(); });
  EXPECT_EQ(ticked.get_future().wait_for(kPatience), std::future_status::ready);
  release.set_value();
  executor.cancel();
  thread.join();
}

TEST_F(EventsCbgExecutorTest, ServesAGroupWithoutItsNode) {
  const auto group = node_->create_callback_group(CallbackGroupType::MutuallyExclusive, false);
  int calls = 0;
  auto timer = node_->create_wall_timer(
      milliseconds(0), [&calls] { ++calls; }, group);
  executor_.spin_some();
  EXPECT_EQ(calls, 0);
  executor_.add_callback_group_only(group);
  executor_.spin_some();
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(executor_.get_manually_added_callback_groups().size(), 1u);
  executor_.remove_callback_group(group);
  executor_.spin_some();
  EXPECT_EQ(calls, 1);
}

// Threads of the executor are busy while another thread adds, removes and destroys.
TEST_F(EventsCbgExecutorTest, NodesAndGroupsComeAndGoUnderLoad) {
  const auto reentrant = node_->create_callback_group(CallbackGroupType::Reentrant);
  const auto publisher = node_->create_publisher<UInt64>("topic", 10);
  auto load = node_->create_wall_timer(
      milliseconds(0), [&publisher] { publisher->publish(UInt64()); }, reentrant);
  std::thread thread([this] { executor_.spin(); });
  for (int round = 0; round < 10; ++round) {
    auto node = std::make_shared<rclcpp::Node>("other");
    std::promise<void> received;
    std::promise<void> called;
    std::atomic<int> messages{0};
    std::atomic<int> calls{0};
    auto group = node->create_callback_group(CallbackGroupType::MutuallyExclusive);
    auto subscription = node->create_subscription<UInt64>(
        "topic", 10,
        [&](const UInt64&) {
          if (++messages == 1) {
            received.set_value();
          }
        },
        in(group));
    auto timer = node->create_wall_timer(milliseconds(0), [&] {
      if (++calls == 1) {
        called.set_value();
      }
    });
    executor_.add_node(node);
    EXPECT_EQ(received.get_future().wait_for(kPatience), std::future_status::ready);
    EXPECT_EQ(called.get_future().wait_for(kPatience), std::future_status::ready);
    if (round % 2 == 0) {
      executor_.remove_node(node);
    }
    // A callback may still run. It ends before the next one of its group begins.
    subscription.reset();
    timer->cancel();
    while (!group->can_be_taken_from() ||
           !node->get_node_base_interface()->get_default_callback_group()->can_be_taken_from()) {
      std::this_thread::yield();
    }
    timer.reset();
  }
  executor_.cancel();
  thread.join();
}

}  // namespace
