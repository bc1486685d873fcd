// SPDX-License-Identifier: Apache-2.0
// Nodes and groups that change their executor while both executors spin.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <thread>
#include <utility>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::CallbackGroupType;
using rclcpp::executors::EventsCBGExecutor;
using rclcpp::executors::MultiThreadedExecutor;
using rclcpp::executors::SingleThreadedExecutor;
using rclcpp::executors::StaticSingleThreadedExecutor;
using rclcpp::experimental::executors::EventsExecutor;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std_msgs::msg::UInt64;

namespace {

// Ready after ring().
class Bell : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override {
    if (before_wait) {
      std::exchange(before_wait, nullptr)();
    }
    ASSERT_EQ(rcl_wait_set_add_guard_condition(&wait_set, &condition_.get_rcl_guard_condition(), &index_), RCL_RET_OK);
  }
  bool is_ready(const rcl_wait_set_t& wait_set) override { return wait_set.guard_conditions[index_] != nullptr; }
  std::shared_ptr<void> take_data() override { return nullptr; }
  void execute(const std::shared_ptr<void>&) override { ++rung; }

  void ring() { condition_.trigger(); }

  std::function<void()> before_wait;  // called once
  std::atomic<int> rung{0};

 private:
  rclcpp::GuardCondition condition_;
  size_t index_ = 0;
};

class MovedNodeTest : public RosTest {
 protected:
  // Adds the group to the first executor, and moves it to the second one in a callback of its own. The callback ends
  // after the second one has found the group busy, and before the second one sleeps.
  void expect_to_be_served_after_callback(rclcpp::Executor& first, rclcpp::Executor& second) {
    std::promise<void> moved;
    std::promise<void> release;
    auto timer = node_->create_wall_timer(
        milliseconds(0),
        [&](rclcpp::TimerBase& self) {
          self.cancel();
          first.remove_callback_group(group_);
          second.add_callback_group(group_, node_->get_node_base_interface());
          moved.set_value();
          release.get_future().wait();
        },
        group_);
    auto bell = std::make_shared<Bell>();
    node_->get_node_waitables_interface()->add_waitable(bell, group_);
    first.add_callback_group(group_, node_->get_node_base_interface());
    std::thread thread([&first] { first.spin_once(kPatience); });
    moved.get_future().wait();
    bell->ring();
    auto other = std::make_shared<Bell>();  // asked after the bell
    other->before_wait = [&] {
      release.set_value();
      thread.join();
    };
    auto other_node = std::make_shared<rclcpp::Node>("other");
    other_node->get_node_waitables_interface()->add_waitable(other, nullptr);
    second.add_node(other_node);
    const auto give_up = std::chrono::steady_clock::now() + kPatience;
    while (bell->rung == 0 && std::chrono::steady_clock::now() < give_up) {
      second.spin_once(kPatience);
    }
    EXPECT_EQ(bell->rung, 1);
  }

  // Each message moves the node to the other executor.
  template <typename FirstT, typename SecondT>
  void expect_to_move_to_and_fro() {
    constexpr uint64_t kMoves = 200;
    FirstT first;
    SecondT second;
    rclcpp::Executor* from = &first;
    rclcpp::Executor* to = &second;
    std::promise<void> done;
    auto publisher = node_->create_publisher<UInt64>("topic", 10);
    auto subscription = node_->create_subscription<UInt64>("topic", 10, [&](const UInt64& message) {
      UInt64 next;
      next.data = message.data + 1;
      if (next.data == kMoves) {
        done.set_value();
        return;
      }
      from->remove_node(node_);
      to->add_node(node_);
      std::swap(from, to);
      publisher->publish(next);
    });
    first.add_node(node_);
    publisher->publish(UInt64());
    std::thread first_thread([&first] { first.spin(); });
    std::thread second_thread([&second] { second.spin(); });
    EXPECT_EQ(done.get_future().wait_for(kPatience), std::future_status::ready);
    while (!first.is_spinning() || !second.is_spinning()) {
      std::this_thread::yield();
    }
    first.cancel();
    second.cancel();
    first_thread.join();
    second_thread.join();
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::CallbackGroup::SharedPtr group_ = node_->create_callback_group(CallbackGroupType::MutuallyExclusive, false);
};

TEST_F(MovedNodeTest, AGroupThatItsCallbackMovedIsServedAfterTheCallback) {
  SingleThreadedExecutor first;
  SingleThreadedExecutor second;
  expect_to_be_served_after_callback(first, second);
}

TEST_F(MovedNodeTest, AGroupThatItsCallbackMovedFromManyThreadsIsServedAfterTheCallback) {
  MultiThreadedExecutor first;
  SingleThreadedExecutor second;
  expect_to_be_served_after_callback(first, second);
}

TEST_F(MovedNodeTest, EachCallbackMayMoveItsNodeBetweenSingleThreadedExecutors) {
  expect_to_move_to_and_fro<SingleThreadedExecutor, StaticSingleThreadedExecutor>();
}

TEST_F(MovedNodeTest, EachCallbackMayMoveItsNodeBetweenOneThreadAndMany) {
  expect_to_move_to_and_fro<SingleThreadedExecutor, MultiThreadedExecutor>();
}

TEST_F(MovedNodeTest, EachCallbackMayMoveItsNodeBetweenManyThreads) {
  expect_to_move_to_and_fro<MultiThreadedExecutor, MultiThreadedExecutor>();
}

TEST_F(MovedNodeTest, EachCallbackMayMoveItsNodeBetweenEventsAndWaiting) {
  expect_to_move_to_and_fro<EventsExecutor, SingleThreadedExecutor>();
}

TEST_F(MovedNodeTest, EachCallbackMayMoveItsNodeBetweenEventsExecutors) {
  expect_to_move_to_and_fro<EventsExecutor, EventsExecutor>();
}

TEST_F(MovedNodeTest, EachCallbackMayMoveItsNodeBetweenQueuesOfGroupsAndOtherExecutors) {
  expect_to_move_to_and_fro<EventsCBGExecutor, SingleThreadedExecutor>();
  expect_to_move_to_and_fro<EventsCBGExecutor, MultiThreadedExecutor>();
  expect_to_move_to_and_fro<EventsCBGExecutor, EventsExecutor>();
}

TEST_F(MovedNodeTest, EachCallbackMayMoveItsNodeBetweenQueuesOfGroups) {
  expect_to_move_to_and_fro<EventsCBGExecutor, EventsCBGExecutor>();
}

// The second executor has work of the group while the callback runs that the first one has begun.
TEST_F(MovedNodeTest, QueuesOfGroupsWaitForTheCallbackThatAnotherExecutorHasBegun) {
  SingleThreadedExecutor first;
  EventsCBGExecutor second;
  std::promise<void> moved;
  std::promise<void> release;
  std::atomic<bool> is_in_callback{false};
  std::atomic<bool> overlapped{false};
  std::promise<void> received;
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  rclcpp::SubscriptionOptions options;
  options.callback_group = group_;
  auto subscription = node_->create_subscription<UInt64>(
      "topic", 10,
      [&](const UInt64&) {
        overlapped = is_in_callback.load();
        received.set_value();
      },
      options);
  auto timer = node_->create_wall_timer(
      milliseconds(0),
      [&](rclcpp::TimerBase& self) {
        self.cancel();
        is_in_callback = true;
        first.remove_callback_group(group_);
        second.add_callback_group(group_, node_->get_node_base_interface());
        moved.set_value();
        release.get_future().wait();
        is_in_callback = false;
      },
      group_);
  first.add_callback_group(group_, node_->get_node_base_interface());
  std::thread first_thread([&first] { first.spin_once(kPatience); });
  moved.get_future().wait();
  std::thread second_thread([&second] { second.spin(); });
  publisher->publish(UInt64());
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  // Another group shows that the executor has looked.
  std::promise<void> looked;
  auto other = std::make_shared<rclcpp::Node>("other");
  auto bystander = other->create_wall_timer(milliseconds(1), [&looked, calls = 0](rclcpp::TimerBase& self) mutable {
    if (++calls == 5) {
      self.cancel();
      looked.set_value();
    }
  });
  second.add_node(other);
  looked.get_future().wait();
  auto future = received.get_future();
  EXPECT_EQ(future.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
  release.set_value();
  EXPECT_EQ(future.wait_for(kPatience), std::future_status::ready);
  EXPECT_FALSE(overlapped);
  first_thread.join();
  second.cancel();
  second_thread.join();
}

TEST_F(MovedNodeTest, AnEventsExecutorThatLearnsLateOfARemovalLeavesTheNodeToTheNextOne) {
  EventsExecutor first;
  EventsExecutor second;
  int received = 0;
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  auto subscription = node_->create_subscription<UInt64>("topic", 10, [&received](const UInt64&) { ++received; });
  first.add_node(node_);
  first.spin_some();
  first.remove_node(node_);
  second.add_node(node_);
  second.spin_some();
  first.spin_some();
  publisher->publish(UInt64());
  EXPECT_TRUE(spin_until(second, [&] { return received == 1; }));
}

TEST_F(MovedNodeTest, AWaitableThatItsFormerExecutorFoundReadyRunsInTheNextOne) {
  SingleThreadedExecutor first;
  SingleThreadedExecutor second;
  auto bell = std::make_shared<Bell>();
  node_->get_node_waitables_interface()->add_waitable(bell, group_);
  auto timer = node_->create_wall_timer(
      milliseconds(0),
      [&](rclcpp::TimerBase& self) {
        self.cancel();
        first.remove_callback_group(group_);
        second.add_callback_group(group_, node_->get_node_base_interface());
      },
      group_);
  first.add_callback_group(group_, node_->get_node_base_interface());
  bell->ring();
  first.spin_once(kPatience);  // finds both ready, and runs the timer
  first.spin_some();
  EXPECT_EQ(bell->rung, 0);
  EXPECT_TRUE(spin_until(second, [&] { return bell->rung == 1; }));
}

}  // namespace
