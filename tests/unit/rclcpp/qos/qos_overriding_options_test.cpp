// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <memory>
#include <std_msgs/msg/string.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::QosOverridingOptions;
using rclcpp::QosPolicyKind;
using std_msgs::msg::String;

namespace {

class QosOverridingOptionsTest : public RosTest {
 protected:
  void start(std::initializer_list<const char*> arguments = {}) {
    node_.reset();
    init(arguments);
    node_ = std::make_shared<rclcpp::Node>("node");
  }

  rclcpp::QoS publisher_qos(QosOverridingOptions options) {
    rclcpp::PublisherOptions publisher_options;
    publisher_options.qos_overriding_options = std::move(options);
    return node_->create_publisher<String>("topic", 10, publisher_options)->get_actual_qos();
  }

  std::string error_of(QosOverridingOptions options) {
    try {
      publisher_qos(std::move(options));
    } catch (const rclcpp::exceptions::InvalidQosOverridesException& error) {
      return error.what();
    }
    return "no exception";
  }

  rclcpp::Node::SharedPtr node_;
};

TEST_F(QosOverridingOptionsTest, DeclareReadOnlyParametersWithTheQosOfTheProgram) {
  start();
  const rclcpp::QoS qos = publisher_qos(QosOverridingOptions::with_default_policies());
  EXPECT_EQ(qos.depth(), 10U);
  EXPECT_EQ(node_->get_parameter("qos_overrides./topic.publisher.history").as_string(), "keep_last");
  EXPECT_EQ(node_->get_parameter("qos_overrides./topic.publisher.depth").as_int(), 10);
  EXPECT_EQ(node_->get_parameter("qos_overrides./topic.publisher.reliability").as_string(), "reliable");
  const auto descriptor = node_->describe_parameter("qos_overrides./topic.publisher.depth");
  EXPECT_TRUE(descriptor.read_only);
  EXPECT_EQ(descriptor.description, "qos policy {depth} for publisher {/topic}");
  EXPECT_FALSE(node_->has_parameter("qos_overrides./topic.publisher.durability"));
}

TEST_F(QosOverridingOptionsTest, ParametersOverrideEveryPolicy) {
  start({"--ros-args", "-p", "qos_overrides./topic.publisher.depth:=3", "-p",
         "qos_overrides./topic.publisher.history:=keep_last", "-p",
         "qos_overrides./topic.publisher.reliability:=best_effort", "-p",
         "qos_overrides./topic.publisher.durability:=transient_local", "-p",
         "qos_overrides./topic.publisher.deadline:=5000000", "-p", "qos_overrides./topic.publisher.lifespan:=6000000",
         "-p", "qos_overrides./topic.publisher.liveliness:=manual_by_topic", "-p",
         "qos_overrides./topic.publisher.liveliness_lease_duration:=7000000"});
  const rclcpp::QoS qos = publisher_qos({QosPolicyKind::Depth, QosPolicyKind::History, QosPolicyKind::Reliability,
                                         QosPolicyKind::Durability, QosPolicyKind::Deadline, QosPolicyKind::Lifespan,
                                         QosPolicyKind::Liveliness, QosPolicyKind::LivelinessLeaseDuration,
                                         QosPolicyKind::AvoidRosNamespaceConventions});
  EXPECT_EQ(qos.depth(), 3U);
  EXPECT_EQ(qos.reliability(), rclcpp::ReliabilityPolicy::BestEffort);
  EXPECT_EQ(qos.durability(), rclcpp::DurabilityPolicy::TransientLocal);
  EXPECT_EQ(qos.deadline().nanoseconds(), 5000000);
  EXPECT_EQ(qos.lifespan().nanoseconds(), 6000000);
  EXPECT_EQ(qos.liveliness(), rclcpp::LivelinessPolicy::ManualByTopic);
  EXPECT_EQ(qos.liveliness_lease_duration().nanoseconds(), 7000000);
}

TEST_F(QosOverridingOptionsTest, SubscriptionsHaveTheirOwnAndAnIdentifierTellsThemApart) {
  start({"--ros-args", "-p", "qos_overrides./there.subscription_left.depth:=4", "-r", "topic:=/there"});
  rclcpp::SubscriptionOptions options;
  options.qos_overriding_options =
      QosOverridingOptions({QosPolicyKind::Depth, QosPolicyKind::Lifespan}, nullptr, "left");
  const auto nothing = [](const String&) {};
  const auto left = node_->create_subscription<String>("topic", 10, nothing, options);
  EXPECT_EQ(left->get_actual_qos().depth(), 4U);
  EXPECT_EQ(node_->describe_parameter("qos_overrides./there.subscription_left.depth").description,
            "qos policy {depth} for subscription {/there} with id {left}");
  // A subscription has no lifespan.
  EXPECT_FALSE(node_->has_parameter("qos_overrides./there.subscription_left.lifespan"));
  // The second one uses the same parameters.
  EXPECT_EQ(node_->create_subscription<String>("topic", 10, nothing, options)->get_actual_qos().depth(), 4U);
}

TEST_F(QosOverridingOptionsTest, RefusesWhatItDoesNotKnow) {
  start({"--ros-args", "-p", "qos_overrides./topic.publisher.reliability:=perhaps", "-p",
         "qos_overrides./topic.publisher.depth:=-1"});
  EXPECT_EQ(error_of({QosPolicyKind::Reliability}),
            "parameter 'qos_overrides./topic.publisher.reliability' has the unknown value 'perhaps': it can be "
            "system_default, reliable, best_effort, best_available");
  EXPECT_EQ(error_of({QosPolicyKind::Depth}), "parameter 'qos_overrides./topic.publisher.depth' is negative: -1");
}

TEST_F(QosOverridingOptionsTest, TheProgramMayRefuse) {
  start({"--ros-args", "-p", "qos_overrides./topic.publisher.depth:=100"});
  const auto at_most_50 = [](const rclcpp::QoS& qos) {
    rclcpp::QosCallbackResult result;
    result.successful = qos.depth() <= 50;
    result.reason = "the queue is too long";
    return result;
  };
  EXPECT_EQ(error_of(QosOverridingOptions::with_default_policies(at_most_50)),
            "validation callback failed: the queue is too long");
}

// As in rclcpp, a program may create its publishers while one of its parameters is set.
TEST_F(QosOverridingOptionsTest, AreDeclaredWhileAParameterIsSet) {
  start();
  node_->declare_parameter("is_on", false);
  rclcpp::QoS qos(1);
  const auto callback = node_->add_post_set_parameters_callback(
      [&](const std::vector<rclcpp::Parameter>&) { qos = publisher_qos({QosPolicyKind::Depth}); });
  const auto other = node_->add_pre_set_parameters_callback([&](std::vector<rclcpp::Parameter>&) {
    EXPECT_THROW(node_->declare_parameter("other", 1), rclcpp::exceptions::ParameterModifiedInCallbackException);
    node_->get_node_parameters_interface()->enable_parameter_modification();
    node_->declare_parameter("other", 1);
  });
  EXPECT_TRUE(node_->set_parameter(rclcpp::Parameter("is_on", true)).successful);
  EXPECT_EQ(qos.depth(), 10U);
  EXPECT_EQ(node_->get_parameter("qos_overrides./topic.publisher.depth").as_int(), 10);
  EXPECT_EQ(node_->get_parameter("other").as_int(), 1);
}

}  // namespace
