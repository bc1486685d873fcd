// SPDX-License-Identifier: Apache-2.0
// An executor of a program's own that keeps its entities in an AllocatorMemoryStrategy.
#include <example_interfaces/srv/add_two_ints.hpp>
#include <memory>
#include <rclcpp/strategies/allocator_memory_strategy.hpp>
#include <std_msgs/msg/u_int64.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using rclcpp::memory_strategies::allocator_memory_strategy::AllocatorMemoryStrategy;
using rclcpp::memory_strategy::MemoryStrategy;
using std_msgs::msg::UInt64;

// Ready when its guard condition was triggered.
class Alarm : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override { condition.add_to_wait_set(wait_set); }
  bool is_ready(const rcl_wait_set_t& wait_set) override {
    for (size_t i = 0; i < wait_set.size_of_guard_conditions; ++i) {
      if (wait_set.guard_conditions[i] == &condition.get_rcl_guard_condition()) {
        return true;
      }
    }
    return false;
  }
  std::shared_ptr<void> take_data() override { return nullptr; }
  void execute(const std::shared_ptr<void>&) override { ++rings; }

  rclcpp::GuardCondition condition;
  int rings = 0;
};

class MemoryStrategyTest : public RosTest {
 protected:
  MemoryStrategyTest() {
    groups_[group_] = node_->get_node_base_interface();
    node_->get_node_waitables_interface()->add_waitable(alarm_, group_);
    alarm_->condition.trigger();
  }

  rclcpp::SubscriptionOptions in_group() const {
    rclcpp::SubscriptionOptions options;
    options.callback_group = group_;
    return options;
  }

  // Waits once for the entities of the group.
  void wait() {
    strategy_.clear_handles();
    EXPECT_FALSE(strategy_.collect_entities(groups_));
    rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
    ASSERT_EQ(rcl_wait_set_init(
                  &wait_set, strategy_.number_of_ready_subscriptions(), strategy_.number_of_guard_conditions(),
                  strategy_.number_of_ready_timers(), strategy_.number_of_ready_clients(),
                  strategy_.number_of_ready_services(), strategy_.number_of_ready_events(),
                  rclcpp::contexts::get_global_default_context()->get_rcl_context().get(), strategy_.get_allocator()),
              RCL_RET_OK);
    EXPECT_TRUE(strategy_.add_handles_to_wait_set(&wait_set));
    const rcl_ret_t result = rcl_wait(&wait_set, 5'000'000);
    EXPECT_TRUE(result == RCL_RET_OK || result == RCL_RET_TIMEOUT);
    strategy_.remove_null_handles(&wait_set);
    EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
  }

  // Runs everything that is ready.
  void run() {
    for (bool found = true; found;) {
      rclcpp::AnyExecutable next;
      strategy_.get_next_timer(next, groups_);
      if (next.timer) {
        next.timer->execute_callback(next.data);
      } else if (strategy_.get_next_subscription(next, groups_); next.subscription) {
        next.subscription->execute();
      } else if (strategy_.get_next_service(next, groups_); next.service) {
        next.service->execute();
      } else if (strategy_.get_next_client(next, groups_); next.client) {
        next.client->execute();
      } else if (strategy_.get_next_waitable(next, groups_); next.waitable) {
        next.waitable->execute(next.waitable->take_data());
      }
      found = next.callback_group != nullptr;
      EXPECT_EQ(next.node_base, found ? node_->get_node_base_interface() : nullptr);
    }
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::CallbackGroup::SharedPtr group_ =
      node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  std::shared_ptr<Alarm> alarm_ = std::make_shared<Alarm>();
  MemoryStrategy::WeakCallbackGroupsToNodesMap groups_;
  AllocatorMemoryStrategy<> strategy_;
};

TEST_F(MemoryStrategyTest, FindsWhatIsReadyOfEveryKind) {
  int ticks = 0;
  const auto timer = node_->create_wall_timer(
      std::chrono::milliseconds(1), [&] { ++ticks; }, group_);
  uint64_t received = 0;
  const auto publisher = node_->create_publisher<UInt64>("topic", rclcpp::QoS(1).transient_local());
  UInt64 message;
  message.data = 7;
  publisher->publish(message);
  const auto subscription = node_->create_subscription<UInt64>(
      "topic", rclcpp::QoS(1).transient_local(), [&](const UInt64& taken) { received = taken.data; }, in_group());
  const auto service = node_->create_service<AddTwoInts>(
      "add",
      [](const AddTwoInts::Request::SharedPtr request, AddTwoInts::Response::SharedPtr response) {
        response->sum = request->a + request->b;
      },
      rclcpp::ServicesQoS(), group_);
  const auto client = node_->create_client<AddTwoInts>("add", rclcpp::ServicesQoS(), group_);
  ASSERT_TRUE(client->wait_for_service(kPatience));
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = 40;
  request->b = 2;
  auto answer = client->async_send_request(request);
  const auto is_done = [&] {
    return ticks > 0 && received == 7 && alarm_->rings > 0 &&
           answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  };
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!is_done() && std::chrono::steady_clock::now() < deadline) {
    wait();
    run();
  }
  ASSERT_TRUE(is_done());
  EXPECT_EQ(answer.get()->sum, 42);
  EXPECT_EQ(alarm_->rings, 1);
}

TEST_F(MemoryStrategyTest, LeavesAGroupAloneWhoseCallbackRuns) {
  const auto timer = node_->create_wall_timer(
      std::chrono::nanoseconds(1), [] {}, group_);
  wait();
  EXPECT_EQ(strategy_.number_of_ready_timers(), 1u);
  EXPECT_EQ(strategy_.number_of_waitables(), 1u);
  EXPECT_EQ(strategy_.number_of_guard_conditions(), 1u);
  group_->can_be_taken_from().store(false);
  rclcpp::AnyExecutable next;
  strategy_.get_next_timer(next, groups_);
  strategy_.get_next_waitable(next, groups_);
  EXPECT_EQ(next.timer, nullptr);
  EXPECT_EQ(next.callback_group, nullptr);
  group_->can_be_taken_from().store(true);
  strategy_.get_next_timer(next, groups_);
  EXPECT_EQ(next.timer, timer);
}

TEST_F(MemoryStrategyTest, ForgetsWhatIsGone) {
  auto timer = node_->create_wall_timer(
      std::chrono::nanoseconds(1), [] {}, group_);
  wait();
  timer.reset();
  rclcpp::AnyExecutable next;
  strategy_.get_next_timer(next, groups_);
  EXPECT_EQ(next.timer, nullptr);
  EXPECT_EQ(strategy_.number_of_ready_timers(), 0u);
  group_.reset();
  EXPECT_TRUE(strategy_.collect_entities(groups_));
}

TEST_F(MemoryStrategyTest, WaitsForGuardConditions) {
  rclcpp::GuardCondition condition;
  strategy_.add_guard_condition(condition);
  strategy_.add_guard_condition(condition);
  EXPECT_EQ(strategy_.number_of_guard_conditions(), 1u);
  strategy_.add_waitable_handle(alarm_);
  EXPECT_EQ(strategy_.number_of_guard_conditions(), 2u);
  EXPECT_THROW(strategy_.add_waitable_handle(nullptr), std::runtime_error);
  rcl_wait_set_t none = rcl_get_zero_initialized_wait_set();
  EXPECT_FALSE(strategy_.add_handles_to_wait_set(&none));
  strategy_.remove_guard_condition(&condition);
  EXPECT_EQ(strategy_.number_of_guard_conditions(), 1u);
}

TEST_F(MemoryStrategyTest, IsPartOfTheOptionsOfExecutors) {
  rclcpp::ExecutorOptions options;
  EXPECT_NE(options.memory_strategy, nullptr);
  options.memory_strategy = std::make_shared<AllocatorMemoryStrategy<>>();
  rclcpp::executors::SingleThreadedExecutor executor(options);
  executor.add_callback_group(group_, node_->get_node_base_interface());
  EXPECT_TRUE(spin_until(executor, [&] { return alarm_->rings == 1; }));
  EXPECT_EQ(options.memory_strategy->number_of_waitables(), 0u);
}

}  // namespace
