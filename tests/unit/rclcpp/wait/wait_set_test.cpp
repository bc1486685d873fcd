// SPDX-License-Identifier: Apache-2.0
#include <example_interfaces/srv/add_two_ints.hpp>
#include <future>
#include <memory>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

using example_interfaces::srv::AddTwoInts;
using rclcpp::WaitResultKind;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std_msgs::msg::UInt64;

namespace {

template <typename FunctionT>
std::string error_of(FunctionT function) {
  try {
    function();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

UInt64 number_message(uint64_t data) {
  UInt64 message;
  message.data = data;
  return message;
}

// Ready when its condition is triggered.
class WaitSetBell : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override {
    ASSERT_EQ(rcl_wait_set_add_guard_condition(&wait_set, &condition.get_rcl_guard_condition(), &index_), RCL_RET_OK);
  }
  bool is_ready(const rcl_wait_set_t& wait_set) override { return wait_set.guard_conditions[index_] != nullptr; }
  std::shared_ptr<void> take_data() override { return nullptr; }
  void execute(const std::shared_ptr<void>&) override {}

  rclcpp::GuardCondition condition;

 private:
  size_t index_ = 0;
};

class WaitSetTest : public RosTest {
 protected:
  rclcpp::Subscription<UInt64>::SharedPtr subscribe(const std::string& topic) {
    return node_->create_subscription<UInt64>(topic, 10, [](const UInt64&) { FAIL() << "no executor is here"; });
  }
  void publish(const std::string& topic, uint64_t data) {
    auto& publisher = publishers_[topic];
    if (!publisher) {
      publisher = node_->create_publisher<UInt64>(topic, 10);
    }
    publisher->publish(number_message(data));
    ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  std::map<std::string, rclcpp::Publisher<UInt64>::SharedPtr> publishers_;
};

TEST_F(WaitSetTest, FindsTheSubscriptionThatHasAMessage) {
  auto a = subscribe("a");
  auto b = subscribe("b");
  rclcpp::WaitSet wait_set({{a}, {b}});
  EXPECT_EQ(wait_set.wait(milliseconds(0)).kind(), WaitResultKind::Timeout);
  publish("b", 7);
  auto result = wait_set.wait(kPatience);
  ASSERT_EQ(result.kind(), WaitResultKind::Ready);
  EXPECT_EQ(result.get_wait_set().get_rcl_wait_set().subscriptions[0], nullptr);
  EXPECT_NE(result.get_wait_set().get_rcl_wait_set().subscriptions[1], nullptr);
  EXPECT_EQ(result.next_ready_subscription(), b);
  EXPECT_EQ(result.next_ready_subscription(), nullptr);
  UInt64 message;
  rclcpp::MessageInfo info;
  ASSERT_TRUE(b->take(message, info));
  EXPECT_EQ(message.data, 7u);
  EXPECT_EQ(wait_set.wait(milliseconds(0)).kind(), WaitResultKind::Timeout);
}

TEST_F(WaitSetTest, FindsEveryOtherKindToo) {
  auto guard_condition = std::make_shared<rclcpp::GuardCondition>();
  auto timer = node_->create_wall_timer(milliseconds(0), [] {});
  auto service = node_->create_service<AddTwoInts>(
      "add", [](const std::shared_ptr<AddTwoInts::Request>, std::shared_ptr<AddTwoInts::Response>) {});
  auto client = node_->create_client<AddTwoInts>("add");
  auto bell = std::make_shared<WaitSetBell>();
  rclcpp::WaitSet wait_set({}, {guard_condition}, {timer}, {client}, {service}, {{bell}});

  auto timer_result = wait_set.wait(kPatience);
  ASSERT_EQ(timer_result.kind(), WaitResultKind::Ready);
  const auto [ready_timer, index] = timer_result.peek_next_ready_timer();
  EXPECT_EQ(ready_timer, timer);
  timer_result.clear_timer_with_index(index);
  EXPECT_EQ(timer_result.peek_next_ready_timer(index).first, nullptr);
  wait_set.remove_timer(timer);

  guard_condition->trigger();
  auto condition_result = wait_set.wait(kPatience);
  ASSERT_EQ(condition_result.kind(), WaitResultKind::Ready);
  EXPECT_NE(wait_set.get_rcl_wait_set().guard_conditions[0], nullptr);
  EXPECT_EQ(condition_result.next_ready_waitable(), nullptr);

  bell->condition.trigger();
  auto waitable_result = wait_set.wait(kPatience);
  ASSERT_EQ(waitable_result.kind(), WaitResultKind::Ready);
  EXPECT_EQ(wait_set.get_rcl_wait_set().guard_conditions[0], nullptr);
  EXPECT_EQ(waitable_result.next_ready_waitable(), bell);

  ASSERT_TRUE(client->wait_for_service(kPatience));
  client->async_send_request(std::make_shared<AddTwoInts::Request>());
  auto service_result = wait_set.wait(kPatience);
  ASSERT_EQ(service_result.kind(), WaitResultKind::Ready);
  EXPECT_EQ(service_result.next_ready_service(), service);
  service->execute();
  auto client_result = wait_set.wait(kPatience);
  ASSERT_EQ(client_result.kind(), WaitResultKind::Ready);
  EXPECT_EQ(client_result.next_ready_client(), client);
}

TEST_F(WaitSetTest, WithoutAnythingToWaitForItIsEmpty) {
  rclcpp::WaitSet wait_set;
  const auto result = wait_set.wait(kPatience);
  EXPECT_EQ(result.kind(), WaitResultKind::Empty);
  EXPECT_EQ(error_of([&] { result.get_wait_set(); }), "cannot access wait set when the result was not ready");
}

TEST_F(WaitSetTest, NeedsAnInitializedContext) {
  const auto context = std::make_shared<rclcpp::Context>();
  EXPECT_THROW(rclcpp::WaitSet({}, {}, {}, {}, {}, {}, context), rclcpp::exceptions::RCLInvalidArgument);
}

TEST_F(WaitSetTest, AResultThatWasMovedFromIsInvalid) {
  rclcpp::WaitSet wait_set;
  auto result = wait_set.wait(milliseconds(0));
  const auto moved = std::move(result);
  EXPECT_EQ(moved.kind(), WaitResultKind::Empty);
  EXPECT_EQ(result.kind(), WaitResultKind::Invalid);  // NOLINT(bugprone-use-after-move)
}

TEST_F(WaitSetTest, AnEntityIsInOneWaitSetAtATime) {
  auto subscription = subscribe("a");
  auto timer = node_->create_wall_timer(std::chrono::hours(1), [] {});
  rclcpp::WaitSet other;
  {
    rclcpp::WaitSet wait_set({{subscription}}, {}, {timer});
    EXPECT_EQ(error_of([&] { other.add_subscription(subscription); }),
              "subscription already in use by another wait set");
    EXPECT_EQ(error_of([&] { other.add_timer(timer); }), "timer already in use by another wait set");
    EXPECT_EQ(error_of([&] { other.remove_timer(timer); }), "timer not in wait set");
    wait_set.remove_timer(timer);
    other.add_timer(timer);
  }
  other.add_subscription(subscription);  // the other wait set is gone
  EXPECT_EQ(error_of([&] { other.add_timer(nullptr); }), "timer is nullptr");
  EXPECT_EQ(error_of([&] { other.remove_waitable(nullptr); }), "waitable is nullptr");
}

TEST_F(WaitSetTest, ForgetsWhatWasDestroyed) {
  auto subscription = subscribe("a");
  auto bell = std::make_shared<WaitSetBell>();
  auto owner = std::make_shared<int>();
  rclcpp::WaitSet wait_set;
  wait_set.add_subscription(subscription);
  wait_set.add_waitable(bell, owner);
  subscription.reset();
  owner.reset();
  wait_set.prune_deleted_entities();
  EXPECT_EQ(wait_set.wait(milliseconds(0)).kind(), WaitResultKind::Empty);
}

TEST_F(WaitSetTest, EventsOfASubscriptionAreWaitedForUnlessTheMaskLeavesThemOut) {
  rclcpp::SubscriptionOptions options;
  options.event_callbacks.matched_callback = [](rclcpp::MatchedInfo&) {};
  auto with_events = node_->create_subscription<UInt64>(
      "a", 10, [](const UInt64&) {}, options);
  auto without_events = node_->create_subscription<UInt64>(
      "a", 10, [](const UInt64&) {}, options);
  rclcpp::SubscriptionWaitSetMask mask;
  mask.include_events = false;
  rclcpp::WaitSet wait_set;
  wait_set.add_subscription(with_events);
  wait_set.add_subscription(without_events, mask);
  auto publisher = node_->create_publisher<UInt64>("a", 10);
  auto result = wait_set.wait(kPatience);
  ASSERT_EQ(result.kind(), WaitResultKind::Ready);
  EXPECT_EQ(result.next_ready_waitable(), with_events->get_event_handlers().at(RCL_SUBSCRIPTION_MATCHED));
  EXPECT_EQ(result.next_ready_waitable(), nullptr);
  wait_set.remove_subscription(with_events);
  wait_set.remove_subscription(without_events, mask);
  EXPECT_EQ(wait_set.wait(milliseconds(0)).kind(), WaitResultKind::Empty);
}

TEST_F(WaitSetTest, MessagesWithinTheProcessAreWaitedForUnlessTheMaskLeavesThemOut) {
  auto node = std::make_shared<rclcpp::Node>("intra", rclcpp::NodeOptions().use_intra_process_comms(true));
  auto publisher = node->create_publisher<UInt64>("a", 10);
  uint64_t received = 0;
  auto subscription =
      node->create_subscription<UInt64>("a", 10, [&](const UInt64& message) { received = message.data; });
  rclcpp::WaitSet wait_set;
  wait_set.add_subscription(subscription);
  publisher->publish(number_message(4));
  auto result = wait_set.wait(kPatience);
  ASSERT_EQ(result.kind(), WaitResultKind::Ready);
  const auto waitable = result.next_ready_waitable();
  ASSERT_EQ(waitable, subscription->get_intra_process_waitable());
  waitable->execute(waitable->take_data());
  EXPECT_EQ(received, 4u);

  wait_set.remove_subscription(subscription);
  rclcpp::SubscriptionWaitSetMask mask;
  mask.include_intra_process_waitable = false;
  wait_set.add_subscription(subscription, mask);
  publisher->publish(number_message(5));
  EXPECT_EQ(wait_set.wait(milliseconds(0)).kind(), WaitResultKind::Timeout);
}

TEST_F(WaitSetTest, AThreadSafeOneTakesNoteOfNewEntitiesWhileItWaits) {
  rclcpp::ThreadSafeWaitSet wait_set;
  auto guard_condition = std::make_shared<rclcpp::GuardCondition>();
  std::promise<void> begun;
  std::thread thread([&] {
    begun.set_value();
    auto result = wait_set.wait(kPatience);
    EXPECT_EQ(result.kind(), WaitResultKind::Ready);
    EXPECT_NE(wait_set.get_rcl_wait_set().guard_conditions[0], nullptr);
  });
  begun.get_future().wait();
  wait_set.add_guard_condition(guard_condition);
  guard_condition->trigger();
  thread.join();
  wait_set.remove_guard_condition(guard_condition);
  EXPECT_EQ(wait_set.wait(milliseconds(1)).kind(), WaitResultKind::Timeout);
}

TEST_F(WaitSetTest, AStaticOneOwnsItsEntities) {
  auto a = subscribe("a");
  auto guard_condition = std::make_shared<rclcpp::GuardCondition>();
  auto timer = node_->create_wall_timer(std::chrono::hours(1), [] {});
  rclcpp::StaticWaitSet<1, 1, 1, 0, 0, 0> wait_set({{{a}}}, {{guard_condition}}, {{timer}});
  const std::weak_ptr<rclcpp::GuardCondition> weak = guard_condition;
  guard_condition->trigger();
  guard_condition.reset();
  EXPECT_FALSE(weak.expired());
  EXPECT_EQ(wait_set.wait(kPatience).kind(), WaitResultKind::Ready);
  publish("a", 1);
  auto result = wait_set.wait(kPatience);
  ASSERT_EQ(result.kind(), WaitResultKind::Ready);
  EXPECT_EQ(result.next_ready_subscription(), a);
}

TEST_F(WaitSetTest, WaitForMessageGivesTheNextOne) {
  auto subscription = subscribe("a");
  publish("a", 3);
  UInt64 message;
  EXPECT_TRUE(
      rclcpp::wait_for_message(message, subscription, rclcpp::contexts::get_global_default_context(), kPatience));
  EXPECT_EQ(message.data, 3u);
  EXPECT_FALSE(
      rclcpp::wait_for_message(message, subscription, rclcpp::contexts::get_global_default_context(), milliseconds(1)));
}

TEST_F(WaitSetTest, WaitForMessageMakesItsSubscriptionAndEndsWithTheContext) {
  auto publisher = node_->create_publisher<UInt64>("a", rclcpp::QoS(1).transient_local());
  publisher->publish(number_message(5));
  UInt64 message;
  EXPECT_TRUE(rclcpp::wait_for_message(message, node_, "a", kPatience, rclcpp::QoS(1).transient_local()));
  EXPECT_EQ(message.data, 5u);

  bool found = true;
  std::thread thread([&] {
    try {
      found = rclcpp::wait_for_message(message, node_, "silent", kPatience);
    } catch (const rclcpp::exceptions::RCLError&) {
      found = false;  // the context ended before the wait began
    }
  });
  while (node_->count_subscribers("silent") == 0) {
    std::this_thread::yield();
  }
  rclcpp::shutdown();
  thread.join();
  EXPECT_FALSE(found);
}

TEST_F(WaitSetTest, NeedsAContext) {
  EXPECT_EQ(error_of([] { rclcpp::WaitSet wait_set({}, {}, {}, {}, {}, {}, nullptr); }), "context is nullptr");
  EXPECT_EQ(error_of([] { rclcpp::GuardCondition condition(nullptr); }), "context argument unexpectedly nullptr");
  EXPECT_THROW(rclcpp::GuardCondition(std::make_shared<rclcpp::Context>()), rclcpp::exceptions::RCLInvalidArgument);
}

TEST_F(WaitSetTest, AGuardConditionWithACallbackWakesItToo) {
  const auto condition = std::make_shared<rclcpp::GuardCondition>();
  size_t called = 0;
  condition->set_on_trigger_callback([&](size_t count) { called += count; });
  rclcpp::WaitSet wait_set({}, {condition}, {}, {}, {}, {});
  condition->trigger();
  EXPECT_EQ(called, 1u);
  EXPECT_EQ(wait_set.wait(kPatience).kind(), WaitResultKind::Ready);
}

}  // namespace
