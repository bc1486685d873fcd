// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <thread>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::experimental::TimersManager;
using rclcpp::experimental::executors::EventsExecutor;
using rclcpp::experimental::executors::ExecutorEvent;
using rclcpp::experimental::executors::SimpleEventsQueue;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std_msgs::msg::UInt64;

namespace {

UInt64 number(uint64_t data) {
  UInt64 message;
  message.data = data;
  return message;
}

class EventsExecutorTest : public RosTest {
 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
};

TEST_F(EventsExecutorTest, ServesEntitiesInTheOrderInWhichTheirMessagesArrived) {
  EventsExecutor executor;
  executor.add_node(node_);
  auto publisher_a = node_->create_publisher<UInt64>("a", 10);
  auto publisher_b = node_->create_publisher<UInt64>("b", 10);
  std::vector<uint64_t> received;
  const auto note = [&received](const UInt64& message) { received.push_back(message.data); };
  auto subscription_a = node_->create_subscription<UInt64>("a", 10, note);
  auto subscription_b = node_->create_subscription<UInt64>("b", 10, note);
  executor.spin_some();
  for (uint64_t i = 0; i < 6; ++i) {
    const auto& publisher = i % 2 == 0 ? publisher_a : publisher_b;
    publisher->publish(number(i));
    ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  }
  ASSERT_TRUE(spin_until(executor, [&] { return received.size() == 6; }));
  EXPECT_EQ(received, (std::vector<uint64_t>{0, 1, 2, 3, 4, 5}));
}

TEST_F(EventsExecutorTest, GivesEachKeptMessageOnceWhenTheHistoryOverflowed) {
  EventsExecutor executor;
  executor.add_node(node_);
  auto publisher = node_->create_publisher<UInt64>("topic", 3);
  std::vector<uint64_t> received;
  auto subscription = node_->create_subscription<UInt64>(
      "topic", 3, [&received](const UInt64& message) { received.push_back(message.data); });
  executor.spin_some();
  for (uint64_t i = 0; i < 10; ++i) {
    publisher->publish(number(i));
  }
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  ASSERT_TRUE(spin_until(executor, [&] { return received.size() == 3; }));
  executor.spin_all(kPatience);
  EXPECT_EQ(received, (std::vector<uint64_t>{7, 8, 9}));
}

TEST_F(EventsExecutorTest, RunsTimersInAThreadOfTheirOwnIfAskedTo) {
  EventsExecutor executor(std::make_unique<SimpleEventsQueue>(), true);
  executor.add_node(node_);
  std::promise<std::thread::id> id;
  std::promise<void> released;
  auto timer = node_->create_wall_timer(milliseconds(0), [&](rclcpp::TimerBase& self) {
    self.cancel();
    id.set_value(std::this_thread::get_id());
    executor.cancel();
  });
  executor.spin();
  EXPECT_NE(id.get_future().get(), std::this_thread::get_id());
}

TEST_F(EventsExecutorTest, NeitherTimersNorMessagesStarveTheOther) {
  EventsExecutor executor;
  executor.add_node(node_);
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  int messages = 0;
  int ticks = 0;
  auto subscription = node_->create_subscription<UInt64>("topic", 10, [&](const UInt64& message) {
    ++messages;
    publisher->publish(message);  // there is always another message
  });
  auto timer = node_->create_wall_timer(milliseconds(0), [&ticks] { ++ticks; });  // always due
  publisher->publish(UInt64());
  EXPECT_TRUE(spin_until(executor, [&] { return messages > 20 && ticks > 20; }));
}

// Returns the newest event first.
class Stack : public rclcpp::experimental::executors::EventsQueue {
 public:
  void enqueue(const ExecutorEvent& event) override {
    {
      const std::lock_guard lock(mutex_);
      events_.insert(events_.end(), event.num_events, {event.entity_key, event.waitable_data, event.type, 1});
    }
    arrived_.notify_one();
  }
  bool dequeue(ExecutorEvent& event, nanoseconds timeout) override {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, std::min<nanoseconds>(timeout, kPatience), [this] { return !events_.empty(); })) {
      return false;
    }
    event = events_.back();
    events_.pop_back();
    return true;
  }
  bool empty() const override { return size() == 0; }
  size_t size() const override {
    const std::lock_guard lock(mutex_);
    return events_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<ExecutorEvent> events_;
};

TEST_F(EventsExecutorTest, TakesItsEventsFromTheQueueItIsGiven) {
  EventsExecutor executor(std::make_unique<Stack>());
  executor.add_node(node_);
  auto publisher_a = node_->create_publisher<UInt64>("a", 10);
  auto publisher_b = node_->create_publisher<UInt64>("b", 10);
  std::vector<char> received;
  auto subscription_a = node_->create_subscription<UInt64>("a", 10, [&](const UInt64&) { received.push_back('a'); });
  auto subscription_b = node_->create_subscription<UInt64>("b", 10, [&](const UInt64&) { received.push_back('b'); });
  executor.spin_some();
  publisher_a->publish(UInt64());
  ASSERT_TRUE(publisher_a->wait_for_all_acked(kPatience));
  publisher_b->publish(UInt64());
  ASSERT_TRUE(publisher_b->wait_for_all_acked(kPatience));
  ASSERT_TRUE(spin_until(executor, [&] { return received.size() == 2; }));
  EXPECT_EQ(received, (std::vector<char>{'b', 'a'}));
  EXPECT_THROW(EventsExecutor(nullptr), std::invalid_argument);
}

// Ready when its guard condition is triggered. It reports the trigger to an executor that does not wait.
class Bell : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override { condition.add_to_wait_set(wait_set); }
  bool is_ready(const rcl_wait_set_t&) override { return true; }
  std::shared_ptr<void> take_data() override { return nullptr; }
  std::shared_ptr<void> take_data_by_entity_id(size_t) override { return nullptr; }
  void execute(const std::shared_ptr<void>&) override { ++rings; }
  void set_on_ready_callback(std::function<void(size_t, int)> callback) override {
    condition.set_on_trigger_callback([callback](size_t count) { callback(count, 0); });
  }
  void clear_on_ready_callback() override { condition.set_on_trigger_callback(nullptr); }

  rclcpp::GuardCondition condition;
  int rings = 0;
};

TEST_F(EventsExecutorTest, HearsOfEveryTriggerOfAGuardCondition) {
  EventsExecutor executor;
  executor.add_node(node_);
  const auto bell = std::make_shared<Bell>();
  bell->condition.trigger();  // reported when a listener is set
  bell->condition.trigger();
  node_->get_node_waitables_interface()->add_waitable(bell, nullptr);
  ASSERT_TRUE(spin_until(executor, [&] { return bell->rings == 2; }));
  std::thread ringing([&] { bell->condition.trigger(); });
  EXPECT_TRUE(spin_until(executor, [&] { return bell->rings == 3; }));
  ringing.join();
  executor.spin_all(kPatience);
  EXPECT_EQ(bell->rings, 3);
}

TEST_F(EventsExecutorTest, RefusesWaitablesThatCannotTell) {
  class Mute : public rclcpp::Waitable {
   public:
    void add_to_wait_set(rcl_wait_set_t&) override {}
    bool is_ready(const rcl_wait_set_t&) override { return false; }
    std::shared_ptr<void> take_data() override { return nullptr; }
    void execute(const std::shared_ptr<void>&) override {}
  };
  auto mute = std::make_shared<Mute>();
  node_->get_node_waitables_interface()->add_waitable(mute, nullptr);
  EventsExecutor executor;
  executor.add_node(node_);
  try {
    executor.spin_some();
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "Custom waitables should override set_on_ready_callback if they want to use it.");
  }
}

TEST_F(EventsExecutorTest, SubscriptionsTellOfMessagesUntilTheirCallbackIsCleared) {
  auto publisher = node_->create_publisher<UInt64>("topic", 10);
  auto subscription = node_->create_subscription<UInt64>("topic", 10, [](const UInt64&) {});
  publisher->publish(UInt64());
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  std::atomic<size_t> told{0};
  subscription->set_on_new_message_callback([&told](size_t count) { told += count; });
  EXPECT_EQ(told, 1u);  // the message from before
  publisher->publish(UInt64());
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  EXPECT_EQ(told, 2u);
  subscription->clear_on_new_message_callback();
  publisher->publish(UInt64());
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  EXPECT_EQ(told, 2u);
  try {
    subscription->set_on_new_message_callback(nullptr);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "The callback passed to set_on_new_message_callback is not callable.");
  }
}

TEST_F(EventsExecutorTest, TimersManagerExecutesTheTimerThatIsLongestDue) {
  TimersManager timers(rclcpp::contexts::get_global_default_context());
  EXPECT_EQ(timers.get_head_timeout(), nanoseconds::max());
  EXPECT_FALSE(timers.execute_head_timer());
  std::vector<char> calls;
  auto a = node_->create_wall_timer(milliseconds(0), [&calls] { calls.push_back('a'); });
  auto b = node_->create_wall_timer(std::chrono::hours(1), [&calls] { calls.push_back('b'); });
  timers.add_timer(a);
  timers.add_timer(b);
  EXPECT_EQ(timers.get_number_ready_timers(), 1u);
  EXPECT_LE(timers.get_head_timeout(), nanoseconds(0));
  EXPECT_TRUE(timers.execute_head_timer());
  timers.remove_timer(a);
  EXPECT_FALSE(timers.execute_head_timer());
  EXPECT_GT(timers.get_head_timeout(), std::chrono::minutes(30));
  EXPECT_EQ(calls, (std::vector<char>{'a'}));
  timers.start();
  EXPECT_THROW(timers.start(), std::runtime_error);
  timers.stop();
}

TEST_F(EventsExecutorTest, TimersManagerHearsOfResetsAndPassesOverTimersThatHaveEnded) {
  int changes = 0;
  TimersManager timers(rclcpp::contexts::get_global_default_context(), [&changes] { ++changes; });
  int calls = 0;
  auto due = node_->create_wall_timer(milliseconds(0), [&calls] { ++calls; });
  auto later = node_->create_wall_timer(std::chrono::hours(1), [&calls] { ++calls; });
  timers.add_timer(due);
  timers.add_timer(later);
  EXPECT_EQ(changes, 2);
  later->cancel();
  EXPECT_LE(timers.get_head_timeout(), nanoseconds(0));
  due.reset();
  EXPECT_EQ(timers.get_head_timeout(), nanoseconds::max());
  EXPECT_FALSE(timers.execute_head_timer());
  later->reset();
  EXPECT_EQ(changes, 3);
  EXPECT_GT(timers.get_head_timeout(), std::chrono::minutes(30));
  int64_t period = 0;
  ASSERT_EQ(rcl_timer_exchange_period(later->get_timer_handle().get(), 0, &period), RCL_RET_OK);
  later->reset();
  EXPECT_EQ(changes, 4);
  EXPECT_TRUE(timers.execute_head_timer());
  EXPECT_EQ(calls, 1);

  const std::weak_ptr<const rcl_timer_t> handle = later->get_timer_handle();
  later.reset();
  timers.remove_expired();
  EXPECT_TRUE(handle.expired());
  timers.clear();
  EXPECT_EQ(timers.get_head_timeout(), nanoseconds::max());
}

TEST_F(EventsExecutorTest, ExecutesManyTimersInTheOrderInWhichTheyAreDue) {
  constexpr int kTimers = 100;
  EventsExecutor executor;
  executor.add_node(node_);
  const auto clock = std::make_shared<rclcpp::Clock>(RCL_ROS_TIME);
  ASSERT_EQ(rcl_enable_ros_time_override(clock->get_clock_handle()), RCL_RET_OK);
  std::vector<int> order;
  std::vector<rclcpp::TimerBase::SharedPtr> timers;
  for (int i = 0; i < kTimers; ++i) {
    const int place = (i * 37) % kTimers;  // each number once, out of order
    timers.push_back(
        rclcpp::create_timer(node_, clock, rclcpp::Duration::from_nanoseconds(place + 1), [&order, &timers, place, i] {
          order.push_back(place);
          timers[static_cast<size_t>(i)]->cancel();
        }));
  }
  executor.spin_some();
  EXPECT_TRUE(order.empty());
  ASSERT_EQ(rcl_set_ros_time_override(clock->get_clock_handle(), kTimers), RCL_RET_OK);
  ASSERT_TRUE(spin_until(executor, [&] { return order.size() == kTimers; }));
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

}  // namespace
