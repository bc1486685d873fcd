// SPDX-License-Identifier: Apache-2.0
// Executors with several threads.
#include <gmock/gmock.h>

#include <atomic>
#include <condition_variable>
#include <example_interfaces/srv/add_two_ints.hpp>
#include <future>
#include <memory>
#include <mutex>
#include <std_msgs/msg/u_int64.hpp>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

using example_interfaces::srv::AddTwoInts;
using rclcpp::CallbackGroupType;
using std::chrono::milliseconds;
using std_msgs::msg::UInt64;

namespace {

// A point where callbacks wait for one another.
class Meeting {
 public:
  // True if `participants` callbacks have arrived in time.
  bool arrive(int participants) {
    std::unique_lock lock(mutex_);
    ++arrived_;
    changed_.notify_all();
    return changed_.wait_for(lock, kPatience, [&] { return arrived_ >= participants; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int arrived_ = 0;
};

template <typename ExecutorT>
std::unique_ptr<rclcpp::Executor> make_executor() {
  return std::make_unique<ExecutorT>(rclcpp::ExecutorOptions(), 4);
}
using MakeExecutor = std::unique_ptr<rclcpp::Executor> (*)();
constexpr MakeExecutor kMultiThreaded = make_executor<rclcpp::executors::MultiThreadedExecutor>;
constexpr MakeExecutor kEventsCbg = make_executor<rclcpp::executors::EventsCBGExecutor>;

class ThreadsTest : public RosTest {
 protected:
  explicit ThreadsTest(MakeExecutor make) : owned_(make()) { executor_.add_node(node_); }

  // A timer that runs once, though a reentrant group lets a second thread in before it is cancelled.
  template <typename CallbackT>
  rclcpp::TimerBase::SharedPtr once(CallbackT callback, const rclcpp::CallbackGroup::SharedPtr& group = nullptr) {
    return node_->create_wall_timer(
        milliseconds(0),
        [callback, has_run = std::make_shared<std::atomic_bool>(false)](rclcpp::TimerBase& self) mutable {
          self.cancel();
          if (!has_run->exchange(true)) {
            callback();
          }
        },
        group);
  }

  // Adds two callbacks in these groups that wait for each other, and spins until both have returned.
  void expect_beside_one_another(const rclcpp::CallbackGroup::SharedPtr& group_a,
                                 const rclcpp::CallbackGroup::SharedPtr& group_b) {
    Meeting meeting;
    std::atomic<int> met{0};
    const auto meet = [&] {
      met += meeting.arrive(2) ? 1 : 0;
      if (met == 2) {
        executor_.cancel();
      }
    };
    auto timer_a = once(meet, group_a);
    auto timer_b = once(meet, group_b);
    executor_.spin();
    EXPECT_EQ(met, 2);
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  const std::unique_ptr<rclcpp::Executor> owned_;
  rclcpp::Executor& executor_ = *owned_;
};

class MultiThreadedExecutorTest : public ThreadsTest {
 protected:
  MultiThreadedExecutorTest() : ThreadsTest(kMultiThreaded) {}
};

class ThreadedExecutorsTest : public ThreadsTest, public testing::WithParamInterface<MakeExecutor> {
 protected:
  ThreadedExecutorsTest() : ThreadsTest(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Each, ThreadedExecutorsTest, testing::Values(kMultiThreaded, kEventsCbg),
                         [](const testing::TestParamInfo<MakeExecutor>& made) {
                           return made.param == kMultiThreaded ? "MultiThreaded" : "EventsCbg";
                         });

template <typename ExecutorT>
void expect_threads_as_asked_for() {
  EXPECT_EQ(ExecutorT(rclcpp::ExecutorOptions(), 4).get_number_of_threads(), 4u);
  EXPECT_EQ(ExecutorT().get_number_of_threads(), std::max(std::thread::hardware_concurrency(), 2u));
}

TEST_F(MultiThreadedExecutorTest, HasAsManyThreadsAsAskedForElseOnePerProcessor) {
  expect_threads_as_asked_for<rclcpp::executors::MultiThreadedExecutor>();
  expect_threads_as_asked_for<rclcpp::executors::EventsCBGExecutor>();
}

TEST_P(ThreadedExecutorsTest, CallbacksOfAReentrantGroupRunBesideOneAnother) {
  const auto group = node_->create_callback_group(CallbackGroupType::Reentrant);
  expect_beside_one_another(group, group);
}

TEST_P(ThreadedExecutorsTest, CallbacksOfTwoExclusiveGroupsRunBesideOneAnother) {
  expect_beside_one_another(node_->create_callback_group(CallbackGroupType::MutuallyExclusive),
                            node_->create_callback_group(CallbackGroupType::MutuallyExclusive));
}

TEST_P(ThreadedExecutorsTest, CallbacksOfAnExclusiveGroupRunOneAtATime) {
  std::atomic<int> running{0};
  std::atomic<int> calls{0};
  std::atomic<bool> overlapped{false};
  const auto callback = [&] {
    overlapped = overlapped || ++running != 1;
    std::this_thread::yield();
    --running;
    if (++calls == 300) {
      executor_.cancel();
    }
  };
  auto timer_a = node_->create_wall_timer(milliseconds(0), callback);
  auto timer_b = node_->create_wall_timer(milliseconds(0), callback);
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  auto subscription = node_->create_subscription<UInt64>("topic", 10, [&](const UInt64&) {
    publisher->publish(UInt64());
    callback();
  });
  publisher->publish(UInt64());
  executor_.spin();
  EXPECT_GE(calls, 300);
  EXPECT_FALSE(overlapped);
}

TEST_P(ThreadedExecutorsTest, OneReentrantSubscriptionTakesSeveralMessagesAtOnce) {
  rclcpp::SubscriptionOptions options;
  options.callback_group = node_->create_callback_group(CallbackGroupType::Reentrant);
  Meeting meeting;
  std::atomic<int> met{0};
  auto subscription = node_->create_subscription<UInt64>(
      "topic", 10,
      [&](const UInt64&) {
        met += meeting.arrive(2) ? 1 : 0;
        if (met == 2) {
          executor_.cancel();
        }
      },
      options);
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  publisher->publish(UInt64());
  publisher->publish(UInt64());
  executor_.spin();
  EXPECT_EQ(met, 2);
}

TEST_P(ThreadedExecutorsTest, ACallbackMayWaitForTheResponseOfAClientInAnotherGroup) {
  // Kept here, because the node has only weak references to groups.
  const auto service_group = node_->create_callback_group(CallbackGroupType::MutuallyExclusive);
  const auto client_group = node_->create_callback_group(CallbackGroupType::MutuallyExclusive);
  auto service = node_->create_service<AddTwoInts>(
      "add",
      [](const std::shared_ptr<AddTwoInts::Request> request, std::shared_ptr<AddTwoInts::Response> response) {
        response->sum = request->a + request->b;
      },
      rclcpp::ServicesQoS(), service_group);
  auto client = node_->create_client<AddTwoInts>("add", rclcpp::ServicesQoS(), client_group);
  ASSERT_TRUE(client->wait_for_service(kPatience));
  int64_t sum = 0;
  auto timer = once([&] {
    auto request = std::make_shared<AddTwoInts::Request>();
    request->a = 2;
    request->b = 3;
    auto future = client->async_send_request(request);
    if (future.wait_for(kPatience) == std::future_status::ready) {
      sum = future.get()->sum;
    }
    executor_.cancel();
  });
  executor_.spin();
  EXPECT_EQ(sum, 5);
}

TEST_P(ThreadedExecutorsTest, AnExceptionEndsEveryThread) {
  auto timer = once([] { throw std::logic_error("mine"); });
  EXPECT_THROW(executor_.spin(), std::logic_error);
  EXPECT_FALSE(executor_.is_spinning());
  auto next = once([this] { executor_.cancel(); });
  executor_.spin();  // spin() may be called again
}

TEST_F(MultiThreadedExecutorTest, OptionsYieldAndTimeoutChangeNothingThatCanBeSeen) {
  executor_.remove_node(node_);
  rclcpp::executors::MultiThreadedExecutor executor(rclcpp::ExecutorOptions(), 2, true, milliseconds(1));
  executor.add_node(node_);
  std::atomic<int> calls{0};
  auto timer = node_->create_wall_timer(milliseconds(3), [&] {
    if (++calls == 3) {
      executor.cancel();
    }
  });
  executor.spin();
  EXPECT_GE(calls, 3);  // the other thread may be in the next call
}

// Ready after trigger(). Counts the waits in which it takes part.
class CountingBell : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override {
    ++waits;
    ASSERT_EQ(rcl_wait_set_add_guard_condition(&wait_set, &condition_.get_rcl_guard_condition(), &index_), RCL_RET_OK);
  }
  bool is_ready(const rcl_wait_set_t& wait_set) override { return wait_set.guard_conditions[index_] != nullptr; }
  std::shared_ptr<void> take_data() override { return nullptr; }
  void execute(const std::shared_ptr<void>&) override {
    {
      const std::lock_guard lock(mutex_);
      ++rung_;
    }
    changed_.notify_all();
  }

  void trigger() { condition_.trigger(); }
  bool wait_for(int times) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return rung_ >= times; });
  }

  std::atomic<int> waits{0};

 private:
  rclcpp::GuardCondition condition_;
  size_t index_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  int rung_ = 0;
};

TEST_F(MultiThreadedExecutorTest, DoesNotTurnRoundWhileAGroupIsBusyThatHasMoreToDo) {
  const auto bell_group = node_->create_callback_group(CallbackGroupType::MutuallyExclusive);
  auto bell = std::make_shared<CountingBell>();
  node_->get_node_waitables_interface()->add_waitable(bell, bell_group);
  std::promise<void> entered;
  std::promise<void> release;
  auto busy = once([&] {
    entered.set_value();
    release.get_future().wait();
  });
  auto more = node_->create_wall_timer(milliseconds(0), [] {});  // always due, in the same group
  std::thread thread([this] { executor_.spin(); });
  entered.get_future().wait();
  const int before = bell->waits;
  for (int i = 1; i <= 20; ++i) {
    bell->trigger();
    ASSERT_TRUE(bell->wait_for(i));
  }
  // Each ring is one wake-up, and its end is another.
  EXPECT_LT(bell->waits - before, 100);
  release.set_value();
  executor_.cancel();
  thread.join();
}

TEST_F(MultiThreadedExecutorTest, AWaitableThatWasTriggeredWhileItsGroupWasBusyRunsAfterwards) {
  auto bell = std::make_shared<CountingBell>();
  node_->get_node_waitables_interface()->add_waitable(bell, nullptr);
  std::promise<void> entered;
  std::promise<void> release;
  auto busy = once([&] {
    entered.set_value();
    release.get_future().wait();
  });
  std::thread thread([this] { executor_.spin(); });
  entered.get_future().wait();
  bell->trigger();
  release.set_value();
  EXPECT_TRUE(bell->wait_for(1));
  executor_.cancel();
  thread.join();
}

TEST_P(ThreadedExecutorsTest, SurvivesEntitiesThatComeAndGoBesideItsThreads) {
  const auto group = node_->create_callback_group(CallbackGroupType::Reentrant);
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  auto keep_busy = node_->create_wall_timer(milliseconds(1), [&publisher] { publisher->publish(UInt64()); });
  std::atomic<int> received{0};
  rclcpp::SubscriptionOptions options;
  options.callback_group = group;
  std::thread thread([this] { executor_.spin(); });
  for (int round = 0; round < 20; ++round) {
    auto subscription = node_->create_subscription<UInt64>(
        "topic", 10, [&received](const UInt64&) { ++received; }, options);
    auto timer = node_->create_wall_timer(
        milliseconds(0), [] {}, group);
    auto node = std::make_shared<rclcpp::Node>("short_lived");
    executor_.add_node(node);
  }
  executor_.cancel();
  thread.join();
  EXPECT_GE(received, 0);
}

}  // namespace
