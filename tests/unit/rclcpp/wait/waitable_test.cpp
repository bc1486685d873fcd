// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <memory>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

// Ready as often as it was triggered.
class Counter : public rclcpp::Waitable {
 public:
  size_t get_number_of_ready_guard_conditions() override { return 1; }

  void add_to_wait_set(rcl_wait_set_t& wait_set) override {
    if (rcl_wait_set_add_guard_condition(&wait_set, &guard_condition_.get_rcl_guard_condition(), &index_) !=
        RCL_RET_OK) {
      throw std::runtime_error("no room");
    }
  }

  bool is_ready(const rcl_wait_set_t& wait_set) override {
    return wait_set.guard_conditions[index_] == &guard_condition_.get_rcl_guard_condition();
  }

  std::shared_ptr<void> take_data() override { return std::make_shared<int>(++taken_); }
  void execute(const std::shared_ptr<void>& data) override { executed.push_back(*static_cast<int*>(data.get())); }

  void trigger() { guard_condition_.trigger(); }

  std::vector<int> executed;

 private:
  rclcpp::GuardCondition guard_condition_;
  size_t index_ = 0;
  int taken_ = 0;
};

// Throws when it is asked while it is triggered.
class Thrower : public Counter {
 public:
  explicit Thrower(const char* message) : message_(message) {}
  bool is_ready(const rcl_wait_set_t& wait_set) override {
    if (Counter::is_ready(wait_set)) {
      throw std::runtime_error(message_);
    }
    return false;
  }

 private:
  const char* message_;
};

class WaitableTest : public RosTest {
 protected:
  WaitableTest() { executor_.add_node(node_); }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(WaitableTest, IsExecutedWithItsDataWhenItsGuardConditionIsTriggered) {
  const auto one = std::make_shared<Counter>();
  const auto other = std::make_shared<Counter>();
  node_->get_node_waitables_interface()->add_waitable(one, nullptr);
  node_->get_node_waitables_interface()->add_waitable(other, nullptr);
  executor_.spin_some();
  EXPECT_THAT(one->executed, testing::IsEmpty());
  std::thread trigger([&one] { one->trigger(); });
  ASSERT_TRUE(spin_until(executor_, [&] { return !one->executed.empty(); }));
  trigger.join();
  one->trigger();
  ASSERT_TRUE(spin_until(executor_, [&] { return one->executed.size() == 2; }));
  EXPECT_THAT(one->executed, testing::ElementsAre(1, 2));
  EXPECT_THAT(other->executed, testing::IsEmpty());
}

TEST_F(WaitableTest, StandsBesideTheEntitiesOfTheNode) {
  const auto waitable = std::make_shared<Counter>();
  node_->get_node_waitables_interface()->add_waitable(waitable, nullptr);
  int ticks = 0;
  const auto timer = node_->create_wall_timer(std::chrono::milliseconds(1), [&] {
    ++ticks;
    waitable->trigger();
  });
  EXPECT_TRUE(spin_until(executor_, [&] { return ticks > 2 && waitable->executed.size() > 2; }));
}

TEST_F(WaitableTest, IsNotExecutedAfterItsRemoval) {
  const auto waitable = std::make_shared<Counter>();
  const auto waitables = node_->get_node_waitables_interface();
  waitables->add_waitable(waitable, nullptr);
  executor_.spin_some();
  waitables->remove_waitable(waitable, nullptr);
  waitable->trigger();
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_THAT(waitable->executed, testing::IsEmpty());
  EXPECT_EQ(waitable.use_count(), 1);
}

TEST_F(WaitableTest, DiesWithItsOwner) {
  auto waitable = std::make_shared<Counter>();
  const std::weak_ptr<Counter> weak = waitable;
  node_->get_node_waitables_interface()->add_waitable(waitable, nullptr);
  executor_.spin_some();
  waitable.reset();
  EXPECT_TRUE(weak.expired());
}

TEST_F(WaitableTest, RunsThoughAnotherOneThrewWhenTheSameWaitAskedIt) {
  const auto before = std::make_shared<Counter>();
  const auto first_thrower = std::make_shared<Thrower>("first");
  const auto between = std::make_shared<Counter>();
  const auto second_thrower = std::make_shared<Thrower>("second");
  const auto after = std::make_shared<Counter>();
  for (const auto& waitable :
       std::vector<std::shared_ptr<Counter>>{before, first_thrower, between, second_thrower, after}) {
    node_->get_node_waitables_interface()->add_waitable(waitable, nullptr);
    waitable->trigger();
  }
  int ticks = 0;
  const auto timer = node_->create_wall_timer(std::chrono::milliseconds(0), [&ticks](rclcpp::TimerBase& self) {
    ++ticks;
    self.cancel();
  });
  try {
    executor_.spin_once(kPatience);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "first");
  }
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_EQ(ticks, 1);
  for (const auto& counter : {before, between, after}) {
    EXPECT_THAT(counter->executed, testing::ElementsAre(1));
  }
}

TEST_F(WaitableTest, IsFoundInAWaitSetThoughAnotherOneThrewWhenTheSameWaitAskedIt) {
  const auto before = std::make_shared<Counter>();
  const auto thrower = std::make_shared<Thrower>("no room");
  const auto after = std::make_shared<Counter>();
  const auto condition = std::make_shared<rclcpp::GuardCondition>();
  rclcpp::WaitSet wait_set({}, {condition}, {}, {}, {}, {{before}, {thrower}, {after}});
  condition->trigger();
  for (const std::shared_ptr<Counter>& waitable : {before, std::shared_ptr<Counter>(thrower), after}) {
    waitable->trigger();
  }
  auto result = wait_set.wait(kPatience);
  ASSERT_EQ(result.kind(), rclcpp::WaitResultKind::Ready);
  EXPECT_NE(wait_set.get_rcl_wait_set().guard_conditions[0], nullptr);
  EXPECT_EQ(result.next_ready_waitable(), before);
  try {
    result.next_ready_waitable();
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no room");
  }
  EXPECT_EQ(result.next_ready_waitable(), after);
  EXPECT_EQ(result.next_ready_waitable(), nullptr);
}

TEST_F(WaitableTest, BelongsToAGroupOfItsNode) {
  const auto other = std::make_shared<rclcpp::Node>("other");
  const auto group = other->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  try {
    node_->get_node_waitables_interface()->add_waitable(std::make_shared<Counter>(), group);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot create: waitable , callback group not in node");
  }
}

}  // namespace
