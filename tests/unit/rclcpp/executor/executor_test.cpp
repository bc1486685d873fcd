// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <memory>
#include <std_msgs/msg/string.hpp>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::FutureReturnCode;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std_msgs::msg::String;

namespace {

class ExecutorTest : public RosTest {
 protected:
  // A timer that is always due.
  template <typename CallbackT>
  rclcpp::TimerBase::SharedPtr eager_timer(CallbackT callback, rclcpp::CallbackGroup::SharedPtr group = nullptr) {
    return node_->create_wall_timer(milliseconds(0), callback, group);
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(ExecutorTest, SpinSomeRunsWhatIsReadyOnce) {
  executor_.add_node(node_);
  int a = 0;
  int b = 0;
  auto timer_a = eager_timer([&a] { ++a; });
  auto timer_b = eager_timer([&b] { ++b; });
  executor_.spin_some();
  EXPECT_EQ(a, 1);
  EXPECT_EQ(b, 1);
  EXPECT_FALSE(executor_.is_spinning());
}

TEST_F(ExecutorTest, SpinOnceRunsOneCallback) {
  executor_.add_node(node_);
  int calls = 0;
  auto timer_a = eager_timer([&calls] { ++calls; });
  auto timer_b = eager_timer([&calls] { ++calls; });
  executor_.spin_once();
  EXPECT_EQ(calls, 1);
}

TEST_F(ExecutorTest, SpinAllStopsAfterItsTime) {
  executor_.add_node(node_);
  int calls = 0;
  auto timer = eager_timer([&calls] { ++calls; });
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while (calls < 10 && std::chrono::steady_clock::now() < give_up) {
    executor_.spin_all(milliseconds(5));  // returns, although there is always more
  }
  EXPECT_GE(calls, 10);
  EXPECT_THROW(executor_.spin_all(nanoseconds(-1)), std::invalid_argument);
}

TEST_F(ExecutorTest, CancelFromACallbackEndsSpin) {
  executor_.add_node(node_);
  int calls = 0;
  auto timer = eager_timer([&] {
    ++calls;
    executor_.cancel();
  });
  executor_.spin();
  EXPECT_EQ(calls, 1);
  executor_.spin();  // spin() may be called again
  EXPECT_EQ(calls, 2);
}

TEST_F(ExecutorTest, CancelFromAnotherThreadWakesAnIdleExecutor) {
  executor_.add_node(node_);
  std::promise<void> spinning;
  auto timer = node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
    self.cancel();
    spinning.set_value();
  });
  std::thread thread([this] { executor_.spin(); });
  spinning.get_future().wait();
  executor_.cancel();
  thread.join();
}

TEST_F(ExecutorTest, ShutdownEndsSpin) {
  executor_.add_node(node_);
  std::promise<void> spinning;
  auto timer = node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
    self.cancel();
    spinning.set_value();
  });
  std::thread thread([this] { executor_.spin(); });
  spinning.get_future().wait();
  rclcpp::shutdown();
  thread.join();
  executor_.spin();  // returns at once
}

TEST_F(ExecutorTest, SpinningTwiceIsRefused) {
  executor_.add_node(node_);
  std::string error;
  auto timer = eager_timer([&] {
    try {
      executor_.spin_some();
    } catch (const std::runtime_error& caught) {
      error = caught.what();
    }
    executor_.cancel();
  });
  executor_.spin();
  EXPECT_EQ(error, "spin_some() called while already spinning");
}

TEST_F(ExecutorTest, AnExceptionOfACallbackComesOutOfSpin) {
  executor_.add_node(node_);
  auto timer = eager_timer([] { throw std::logic_error("mine"); });
  EXPECT_THROW(executor_.spin(), std::logic_error);
  EXPECT_FALSE(executor_.is_spinning());
}

TEST_F(ExecutorTest, SpinUntilFutureCompleteTellsHowItEnded) {
  executor_.add_node(node_);
  std::promise<int> never;
  EXPECT_EQ(executor_.spin_until_future_complete(never.get_future(), milliseconds(5)), FutureReturnCode::TIMEOUT);

  std::promise<int> promise;
  auto future = promise.get_future();
  auto timer = node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
    promise.set_value(3);
    self.cancel();
  });
  EXPECT_EQ(executor_.spin_until_future_complete(future, kPatience), FutureReturnCode::SUCCESS);
  EXPECT_EQ(future.get(), 3);

  auto other = eager_timer([this] { executor_.cancel(); });
  std::promise<int> never_too;
  EXPECT_EQ(executor_.spin_until_future_complete(never_too.get_future()), FutureReturnCode::INTERRUPTED);
  EXPECT_EQ(to_string(FutureReturnCode::INTERRUPTED), "INTERRUPTED (1)");
}

TEST_F(ExecutorTest, FreeFunctionsSpinANodeForAWhile) {
  int calls = 0;
  auto timer = eager_timer([&calls] { ++calls; });
  rclcpp::spin_some(node_);
  EXPECT_EQ(calls, 1);
  std::promise<void> ready;
  ready.set_value();
  EXPECT_EQ(rclcpp::spin_until_future_complete(node_, ready.get_future()), FutureReturnCode::SUCCESS);
  executor_.add_node(node_);  // free again
  EXPECT_THROW(rclcpp::spin_some(node_), std::runtime_error);
}

TEST_F(ExecutorTest, ANodeBelongsToOneExecutor) {
  executor_.add_node(node_);
  rclcpp::executors::SingleThreadedExecutor other;
  try {
    other.add_node(node_);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "Node '/node' has already been added to an executor.");
  }
  EXPECT_THROW(other.remove_node(node_), std::runtime_error);
  executor_.remove_node(node_);
  other.add_node(node_);
}

TEST_F(ExecutorTest, NothingOfARemovedNodeRuns) {
  executor_.add_node(node_);
  int calls = 0;
  auto timer_a = eager_timer([&calls] { ++calls; });
  auto timer_b = eager_timer([&calls] { ++calls; });
  executor_.spin_once();  // both were ready in one wait
  executor_.remove_node(node_);
  executor_.spin_once(milliseconds(0));
  EXPECT_EQ(calls, 1);
}

TEST_F(ExecutorTest, EntitiesMayBeAddedAndDroppedByCallbacks) {
  executor_.add_node(node_);
  int child_calls = 0;
  rclcpp::TimerBase::SharedPtr child;
  rclcpp::TimerBase::SharedPtr parent = node_->create_wall_timer(milliseconds(0), [&] {
    child = node_->create_wall_timer(milliseconds(0), [&child_calls] { ++child_calls; });
    parent.reset();
  });
  ASSERT_TRUE(spin_until(executor_, [&] { return child_calls == 2; }));
  EXPECT_EQ(parent, nullptr);
}

TEST_F(ExecutorTest, AnEntityAddedByAnotherThreadIsServedAtOnce) {
  executor_.add_node(node_);
  std::promise<void> spinning;
  auto first = node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
    self.cancel();
    spinning.set_value();
  });
  std::thread thread([this] { executor_.spin(); });
  spinning.get_future().wait();
  std::promise<void> served;
  auto second = node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
    self.cancel();
    served.set_value();
  });
  EXPECT_EQ(served.get_future().wait_for(kPatience), std::future_status::ready);
  executor_.cancel();
  thread.join();
}

TEST_F(ExecutorTest, ADroppedSubscriptionIsGoneAtOnceWithoutSpinning) {
  executor_.add_node(node_);
  auto publisher = node_->create_publisher<String>("topic", 10);
  auto subscription = node_->create_subscription<String>("topic", 10, [](const String&) {});
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  const std::weak_ptr<rcl_subscription_t> handle = subscription->get_subscription_handle();
  subscription.reset();
  EXPECT_TRUE(handle.expired());
}

TEST_F(ExecutorTest, CallbackGroupsCanBeAddedOneByOne) {
  auto group = node_->create_callback_group(rclcpp::CallbackGroupType::Reentrant, false);
  int in_group = 0;
  int in_node = 0;
  auto group_timer = eager_timer([&in_group] { ++in_group; }, group);
  auto node_timer = eager_timer([&in_node] { ++in_node; });
  executor_.add_callback_group(group, node_->get_node_base_interface());
  executor_.spin_some();
  EXPECT_EQ(in_group, 1);
  EXPECT_EQ(in_node, 0);
  EXPECT_THROW(executor_.add_callback_group(group, node_->get_node_base_interface()), std::runtime_error);

  executor_.add_node(node_);
  EXPECT_EQ(executor_.get_all_callback_groups().size(), 2u);
  executor_.remove_callback_group(group);
  executor_.spin_some();
  EXPECT_EQ(in_group, 1);
  EXPECT_EQ(in_node, 1);
}

TEST_F(ExecutorTest, GroupsOfOtherNodesAreRefused) {
  rclcpp::Node other("other");
  auto group = other.create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  EXPECT_THROW(eager_timer([] {}, group), std::runtime_error);
}

TEST_F(ExecutorTest, SurvivesTheDestructionOfItsNodesInAnyOrder) {
  executor_.add_node(node_);
  auto timer = eager_timer([] {});
  auto subscription = node_->create_subscription<String>("topic", 10, [](const String&) {});
  executor_.spin_some();
  node_.reset();
  executor_.spin_some();  // the rest of the node waits until its pointers are gone
  timer.reset();
  executor_.spin_some();
  subscription.reset();
  {
    rclcpp::executors::SingleThreadedExecutor gone_first;
    node_ = std::make_shared<rclcpp::Node>("node");
    gone_first.add_node(node_);
  }
  executor_.add_node(node_);
}

TEST_F(ExecutorTest, PublishersOutliveNodeAndContext) {
  auto publisher = node_->create_publisher<String>("topic", 10);
  auto subscription = node_->create_subscription<String>("topic", 10, [](const String&) {});
  node_.reset();
  publisher->publish(String());
  rclcpp::shutdown();
  publisher.reset();
  subscription.reset();
}

TEST_F(ExecutorTest, CreatingAndDestroyingBesideASpinningThreadIsSafe) {
  executor_.add_node(node_);
  auto publisher = node_->create_publisher<String>("topic", 10);
  auto keep_busy = node_->create_wall_timer(milliseconds(1), [&publisher] { publisher->publish(String()); });
  std::atomic<int> received{0};
  std::thread thread([this] { executor_.spin(); });
  for (int round = 0; round < 20; ++round) {
    auto subscription = node_->create_subscription<String>("topic", 10, [&received](const String&) { ++received; });
    auto timer = node_->create_wall_timer(milliseconds(1), [] {});
    auto node = std::make_shared<rclcpp::Node>("short_lived");
    executor_.add_node(node);
  }
  executor_.cancel();
  thread.join();
  EXPECT_GE(received, 0);
}

}  // namespace
