// SPDX-License-Identifier: Apache-2.0
// Events of publishers and subscriptions, from the middleware to the callbacks in the options.
#include <gmock/gmock.h>
#include <rcutils/logging.h>

#include <cstdio>
#include <memory>
#include <mutex>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <std_msgs/msg/int32.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using std::chrono::milliseconds;
using std_msgs::msg::String;

namespace {

std::mutex lines_mutex;
std::vector<std::string> lines;

void keep_line(const rcutils_log_location_t*, int severity, const char* name, rcutils_time_point_value_t,
               const char* format, va_list* args) {
  char text[512];
  vsnprintf(text, sizeof text, format, *args);
  const std::lock_guard lock(lines_mutex);
  lines.push_back(std::string(rcutils_logging_severity_name(severity)) + " " + name + ": " + text);
}

size_t count_lines() {
  const std::lock_guard lock(lines_mutex);
  return lines.size();
}

class QosEventTest : public RosTest {
 protected:
  QosEventTest() {
    executor_.add_node(node_);
    lines.clear();
    rcutils_logging_set_output_handler(keep_line);
  }
  ~QosEventTest() override { rcutils_logging_set_output_handler(rcutils_logging_console_output_handler); }

  static void ignore(const String&) {}

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node", "ns");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(QosEventTest, IncompatibleEndpointsAreWarnedOfByDefault) {
  auto publisher = node_->create_publisher<String>("topic", rclcpp::QoS(1).best_effort());
  auto subscription = node_->create_subscription<String>("topic", rclcpp::QoS(1).reliable(), ignore);
  ASSERT_TRUE(spin_until(executor_, [] { return count_lines() == 2; }));
  EXPECT_THAT(lines, testing::UnorderedElementsAre(
                         "WARN ns.node: New subscription discovered on topic '/ns/topic', requesting incompatible QoS. "
                         "No messages will be sent to it. Last incompatible policy: RELIABILITY_QOS_POLICY",
                         "WARN ns.node: New publisher discovered on topic '/ns/topic', offering incompatible QoS. No "
                         "messages will be received from it. Last incompatible policy: RELIABILITY_QOS_POLICY"));
}

TEST_F(QosEventTest, TheDefaultWarningsCanBeReplacedAndSwitchedOff) {
  int incompatible = 0;
  rmw_qos_policy_kind_t policy = RMW_QOS_POLICY_INVALID;
  rclcpp::PublisherOptions publisher_options;
  publisher_options.event_callbacks.incompatible_qos_callback = [&](rclcpp::QOSOfferedIncompatibleQoSInfo& info) {
    incompatible = info.total_count;
    policy = info.last_policy_kind;
  };
  rclcpp::SubscriptionOptions subscription_options;
  subscription_options.use_default_callbacks = false;
  auto publisher = node_->create_publisher<String>("topic", rclcpp::QoS(1).durability_volatile(), publisher_options);
  auto subscription =
      node_->create_subscription<String>("topic", rclcpp::QoS(1).transient_local(), ignore, subscription_options);
  EXPECT_EQ(publisher->get_event_handlers().size(), 2u);  // the handler for incompatible types is there by default
  EXPECT_EQ(subscription->get_event_handlers().size(), 0u);
  ASSERT_TRUE(spin_until(executor_, [&] { return incompatible == 1; }));
  EXPECT_EQ(policy, RMW_QOS_POLICY_DURABILITY);
  EXPECT_EQ(count_lines(), 0u);
}

TEST_F(QosEventTest, BothSidesHearOfMissedDeadlines) {
  int offered = 0;
  int requested = 0;
  rclcpp::PublisherOptions publisher_options;
  publisher_options.event_callbacks.deadline_callback = [&](rclcpp::QOSDeadlineOfferedInfo& info) {
    offered = info.total_count;
  };
  rclcpp::SubscriptionOptions subscription_options;
  subscription_options.event_callbacks.deadline_callback = [&](rclcpp::QOSDeadlineRequestedInfo& info) {
    requested = info.total_count;
  };
  const auto qos = rclcpp::QoS(1).deadline(milliseconds(20));
  auto publisher = node_->create_publisher<String>("topic", qos, publisher_options);
  auto subscription = node_->create_subscription<String>("topic", qos, ignore, subscription_options);
  publisher->publish(String());
  EXPECT_TRUE(spin_until(executor_, [&] { return offered > 0 && requested > 0; }));
}

TEST_F(QosEventTest, BothSidesHearOfLostLivelinessAndOfItsReturn) {
  int lost = 0;
  int alive = 0;
  int not_alive = 0;
  rclcpp::PublisherOptions publisher_options;
  publisher_options.event_callbacks.liveliness_callback = [&](rclcpp::QOSLivelinessLostInfo& info) {
    lost = info.total_count;
  };
  rclcpp::SubscriptionOptions subscription_options;
  subscription_options.event_callbacks.liveliness_callback = [&](rclcpp::QOSLivelinessChangedInfo& info) {
    alive += info.alive_count_change;
    not_alive = info.not_alive_count;
  };
  const auto qos =
      rclcpp::QoS(1).liveliness(rclcpp::LivelinessPolicy::ManualByTopic).liveliness_lease_duration(milliseconds(50));
  auto publisher = node_->create_publisher<String>("topic", qos, publisher_options);
  auto subscription = node_->create_subscription<String>("topic", qos, ignore, subscription_options);
  ASSERT_TRUE(publisher->assert_liveliness());
  ASSERT_TRUE(spin_until(executor_, [&] { return lost > 0 && not_alive == 1; }));
  ASSERT_TRUE(publisher->assert_liveliness());
  EXPECT_TRUE(spin_until(executor_, [&] { return lost > 1; }));
}

TEST_F(QosEventTest, MatchesAreToldInTheGroupOfTheOptions) {
  const auto group = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  size_t publisher_matches = 0;
  size_t subscription_matches = 0;
  rclcpp::PublisherOptions publisher_options;
  publisher_options.callback_group = group;
  publisher_options.event_callbacks.matched_callback = [&](rclcpp::MatchedInfo& info) {
    publisher_matches = info.current_count;
  };
  rclcpp::SubscriptionOptions subscription_options;
  subscription_options.event_callbacks.matched_callback = [&](rclcpp::MatchedInfo& info) {
    subscription_matches = info.current_count;
  };
  auto publisher = node_->create_publisher<String>("topic", 1, publisher_options);
  auto subscription = node_->create_subscription<String>("topic", 1, ignore, subscription_options);
  ASSERT_TRUE(spin_until(executor_, [&] { return subscription_matches == 1; }));
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_EQ(publisher_matches, 0u);
  executor_.add_callback_group(group, node_->get_node_base_interface());
  EXPECT_TRUE(spin_until(executor_, [&] { return publisher_matches == 1; }));
  subscription.reset();
  EXPECT_TRUE(spin_until(executor_, [&] { return publisher_matches == 0; }));
}

template <typename ExecutorT>
class NotifiedExecutorsTest : public QosEventTest {};
using NotifiedExecutors =
    testing::Types<rclcpp::experimental::executors::EventsExecutor, rclcpp::executors::EventsCBGExecutor>;
TYPED_TEST_SUITE(NotifiedExecutorsTest, NotifiedExecutors);

TYPED_TEST(NotifiedExecutorsTest, HearOfThemToo) {
  this->executor_.remove_node(this->node_);
  const rclcpp::Node::SharedPtr node = this->node_;
  TypeParam executor;
  executor.add_node(node);
  size_t matches = 0;
  rclcpp::PublisherOptions options;
  options.event_callbacks.matched_callback = [&](rclcpp::MatchedInfo& info) { matches = info.current_count; };
  auto publisher = node->create_publisher<String>("topic", 1, options);
  auto subscription = node->create_subscription<String>("topic", 1, this->ignore);
  ASSERT_TRUE(spin_until(executor, [&] { return matches == 1; }));
  subscription.reset();
  EXPECT_TRUE(spin_until(executor, [&] { return matches == 0; }));
}

// A node of another participant: in one, a topic has one type.
class OtherParticipant {
 public:
  explicit OtherParticipant(rclcpp::Executor& executor) {
    context_->init(0, nullptr);
    node = std::make_shared<rclcpp::Node>("other", "ns", rclcpp::NodeOptions().context(context_));
    rclcpp::ExecutorOptions options;
    options.context = context_;
    executor_ = std::make_unique<rclcpp::executors::SingleThreadedExecutor>(options);
    executor_->add_node(node);
    first_ = &executor;
  }
  ~OtherParticipant() { context_->shutdown("the test is over"); }

  template <typename ConditionT>
  bool spin_both_until(ConditionT condition) {
    return spin_until(*first_, [&] {
      executor_->spin_some();
      return condition();
    });
  }

  rclcpp::Node::SharedPtr node;

 private:
  std::shared_ptr<rclcpp::Context> context_ = std::make_shared<rclcpp::Context>();
  std::unique_ptr<rclcpp::executors::SingleThreadedExecutor> executor_;
  rclcpp::Executor* first_;
};

TEST_F(QosEventTest, EndpointsOfAnotherTypeAreTold) {
  OtherParticipant other(executor_);
  int of_publisher = 0;
  int of_subscription = 0;
  rclcpp::PublisherOptions publisher_options;
  publisher_options.event_callbacks.incompatible_type_callback = [&](rclcpp::IncompatibleTypeInfo& info) {
    of_publisher = info.total_count;
  };
  rclcpp::SubscriptionOptions subscription_options;
  subscription_options.event_callbacks.incompatible_type_callback = [&](rclcpp::IncompatibleTypeInfo& info) {
    of_subscription = info.total_count;
  };
  auto publisher = node_->create_publisher<String>("topic", 1, publisher_options);
  auto subscription = other.node->create_subscription<std_msgs::msg::Int32>(
      "topic", 1, [](const std_msgs::msg::Int32&) {}, subscription_options);
  EXPECT_TRUE(other.spin_both_until([&] { return of_publisher == 1 && of_subscription == 1; }));
  EXPECT_EQ(count_lines(), 0u);
}

TEST_F(QosEventTest, EndpointsOfAnotherTypeAreWarnedOfByDefault) {
  OtherParticipant other(executor_);
  auto publisher = node_->create_publisher<String>("topic", 1);
  auto subscription =
      other.node->create_subscription<std_msgs::msg::Int32>("topic", 1, [](const std_msgs::msg::Int32&) {});
  ASSERT_TRUE(other.spin_both_until([] { return count_lines() == 2; }));
  EXPECT_THAT(lines,
              testing::UnorderedElementsAre(
                  "WARN ns.node: Incompatible type on topic '/ns/topic', no messages will be sent to it.",
                  "WARN ns.other: Incompatible type on topic '/ns/topic', no messages will be received from it."));
}

TEST_F(QosEventTest, APublisherIsGoneAtOnceThoughAnExecutorKnowsItsEvents) {
  auto publisher = node_->create_publisher<String>("topic", 1);
  executor_.spin_some();
  const std::weak_ptr<rcl_publisher_t> handle = publisher->get_publisher_handle();
  publisher.reset();
  EXPECT_TRUE(handle.expired());
}

TEST_F(QosEventTest, AHandlerTakesAnyFunctionOfTheStatus) {
  const auto publisher = node_->create_publisher<String>("topic", 1);
  int32_t total = 0;
  auto callback = [&total](rclcpp::MatchedInfo status) { total = static_cast<int32_t>(status.total_count); };
  using Handler = rclcpp::EventHandler<decltype(callback), std::shared_ptr<rcl_publisher_t>>;
  const auto handler = std::make_shared<Handler>(callback, rcl_publisher_event_init, publisher->get_publisher_handle(),
                                                 RCL_PUBLISHER_MATCHED);
  node_->get_node_waitables_interface()->add_waitable(handler, nullptr);
  const auto subscription = node_->create_subscription<String>("topic", 1, ignore);
  EXPECT_TRUE(spin_until(executor_, [&] { return total == 1; }));
}

TEST_F(QosEventTest, PoliciesHaveNames) {
  EXPECT_EQ(rclcpp::qos_policy_name_from_kind(RMW_QOS_POLICY_DEADLINE), "DEADLINE_QOS_POLICY");
  EXPECT_EQ(rclcpp::qos_policy_name_from_kind(RMW_QOS_POLICY_INVALID), "INVALID_QOS_POLICY");
}

}  // namespace
