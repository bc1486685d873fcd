// SPDX-License-Identifier: Apache-2.0
// The interfaces of a node are abstract: a program may implement them.
#include <future>
#include <memory>
#include <rclcpp/node_interfaces/node_interfaces.hpp>
#include <string>
#include <type_traits>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

namespace interfaces = rclcpp::node_interfaces;

static_assert(std::is_abstract_v<interfaces::NodeBaseInterface>);
static_assert(std::is_abstract_v<interfaces::NodeClockInterface>);
static_assert(std::is_abstract_v<interfaces::NodeGraphInterface>);
static_assert(std::is_abstract_v<interfaces::NodeLoggingInterface>);
static_assert(std::is_abstract_v<interfaces::NodeParametersInterface>);
static_assert(std::is_abstract_v<interfaces::NodeServicesInterface>);
static_assert(std::is_abstract_v<interfaces::NodeTimersInterface>);
static_assert(std::is_abstract_v<interfaces::NodeTopicsInterface>);
static_assert(std::is_abstract_v<interfaces::NodeWaitablesInterface>);

// What a wrapper around a node writes.
class BaseOfAnother : public interfaces::NodeBaseInterface {
 public:
  explicit BaseOfAnother(NodeBaseInterface::SharedPtr other) : other_(std::move(other)) {}

  const char* get_name() const override { return "wrapped"; }
  const char* get_namespace() const override { return other_->get_namespace(); }
  const char* get_fully_qualified_name() const override { return "/wrapped"; }
  rclcpp::Context::SharedPtr get_context() override { return other_->get_context(); }
  rcl_node_t* get_rcl_node_handle() override { return other_->get_rcl_node_handle(); }
  const rcl_node_t* get_rcl_node_handle() const override { return other_->get_rcl_node_handle(); }
  std::shared_ptr<rcl_node_t> get_shared_rcl_node_handle() override { return other_->get_shared_rcl_node_handle(); }
  std::shared_ptr<const rcl_node_t> get_shared_rcl_node_handle() const override {
    return other_->get_shared_rcl_node_handle();
  }
  rclcpp::CallbackGroup::SharedPtr create_callback_group(rclcpp::CallbackGroupType type, bool automatically) override {
    return other_->create_callback_group(type, automatically);
  }
  rclcpp::CallbackGroup::SharedPtr get_default_callback_group() override {
    return other_->get_default_callback_group();
  }
  bool callback_group_in_node(rclcpp::CallbackGroup::SharedPtr group) override {
    return other_->callback_group_in_node(group);
  }
  void for_each_callback_group(const CallbackGroupFunction& function) override {
    other_->for_each_callback_group(function);
  }
  std::atomic_bool& get_associated_with_executor_atomic() override {
    return other_->get_associated_with_executor_atomic();
  }
  rclcpp::GuardCondition& get_notify_guard_condition() override { return other_->get_notify_guard_condition(); }
  rclcpp::GuardCondition::SharedPtr get_shared_notify_guard_condition() override {
    return other_->get_shared_notify_guard_condition();
  }
  void trigger_notify_guard_condition() override { other_->trigger_notify_guard_condition(); }
  bool get_use_intra_process_default() const override { return other_->get_use_intra_process_default(); }
  bool get_enable_topic_statistics_default() const override { return other_->get_enable_topic_statistics_default(); }
  std::string resolve_topic_or_service_name(const std::string& name, bool is_service, bool only_expand) const override {
    return other_->resolve_topic_or_service_name(name, is_service, only_expand);
  }

 private:
  NodeBaseInterface::SharedPtr other_;
};

class ClockOfTests : public interfaces::NodeClockInterface {
 public:
  rclcpp::Clock::SharedPtr get_clock() override { return clock_; }
  rclcpp::Clock::ConstSharedPtr get_clock() const override { return clock_; }

 private:
  rclcpp::Clock::SharedPtr clock_ = std::make_shared<rclcpp::Clock>(RCL_STEADY_TIME);
};

class NodeInterfacesTest : public RosTest {
 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
};

TEST_F(NodeInterfacesTest, AnExecutorServesABaseOfTheProgram) {
  rclcpp::executors::SingleThreadedExecutor executor;
  const auto base = std::make_shared<BaseOfAnother>(node_->get_node_base_interface());
  executor.add_node(base);
  EXPECT_TRUE(base->get_associated_with_executor_atomic());
  // The group comes later, while the executor waits.
  std::promise<void> called;
  rclcpp::TimerBase::SharedPtr timer;
  rclcpp::CallbackGroup::SharedPtr group;
  auto created = std::async(std::launch::async, [&] {
    group = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    timer = node_->create_wall_timer(
        std::chrono::milliseconds(1),
        [&called](rclcpp::TimerBase& self) {
          self.cancel();
          called.set_value();
        },
        group);
  });
  EXPECT_EQ(executor.spin_until_future_complete(called.get_future(), kPatience), rclcpp::FutureReturnCode::SUCCESS);
  created.get();
  executor.remove_node(base);
  EXPECT_FALSE(base->get_associated_with_executor_atomic());
}

// The guard condition of the node has a lock, under which it tells the executor of the change.
TEST_F(NodeInterfacesTest, ABaseOfTheProgramIsRemovedWhileItChanges) {
  const auto base = std::make_shared<BaseOfAnother>(node_->get_node_base_interface());
  auto changes = std::async(std::launch::async, [&] {
    for (int i = 0; i < 30000; ++i) {
      node_->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
    }
  });
  do {
    rclcpp::executors::SingleThreadedExecutor executor;
    for (int i = 0; i < 100; ++i) {
      executor.add_node(base);
      executor.remove_node(base);
    }
    executor.add_node(base);
  } while (changes.wait_for(std::chrono::seconds(0)) != std::future_status::ready);
  EXPECT_FALSE(base->get_associated_with_executor_atomic());
}

TEST_F(NodeInterfacesTest, AClockOfTheProgramCanStandInForTheOneOfTheNode) {
  using interfaces::NodeBaseInterface;
  using interfaces::NodeClockInterface;
  const std::shared_ptr<NodeClockInterface> clock = std::make_shared<ClockOfTests>();
  interfaces::NodeInterfaces<NodeBaseInterface, NodeClockInterface> mixed(node_->get_node_base_interface(), clock);
  EXPECT_EQ(mixed.get_node_clock_interface()->get_clock()->get_clock_type(), RCL_STEADY_TIME);
  EXPECT_STREQ(mixed.get_node_base_interface()->get_name(), "node");
}

TEST_F(NodeInterfacesTest, ANodeHasATimeSource) {
  EXPECT_NE(node_->get_node_time_source_interface(), nullptr);
  EXPECT_EQ(node_->create_sub_node("sub")->get_node_time_source_interface(), node_->get_node_time_source_interface());
}

TEST_F(NodeInterfacesTest, TheNotifyConditionIsTriggeredByNewGroups) {
  const auto condition = node_->get_node_base_interface()->get_shared_notify_guard_condition();
  size_t changes = 0;
  condition->set_on_trigger_callback([&](size_t count) { changes += count; });
  const auto group = node_->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  EXPECT_EQ(changes, 1u);
  node_->get_node_base_interface()->trigger_notify_guard_condition();
  EXPECT_EQ(changes, 2u);
  condition->set_on_trigger_callback(nullptr);
}

}  // namespace
