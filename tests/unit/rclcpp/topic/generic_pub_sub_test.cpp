// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <memory>
#include <rclcpp/typesupport_helpers.hpp>
#include <std_msgs/msg/string.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::SerializedMessage;
using std_msgs::msg::String;
using testing::ElementsAre;

namespace {

class GenericPubSubTest : public RosTest {
 protected:
  GenericPubSubTest() { executor_.add_node(node_); }

  static SerializedMessage bytes_of(const std::string& text) {
    String message;
    message.data = text;
    SerializedMessage bytes;
    rclcpp::Serialization<String>().serialize_message(&message, &bytes);
    return bytes;
  }
  static std::string text_of(const SerializedMessage& bytes) {
    String message;
    rclcpp::Serialization<String>().deserialize_message(&bytes, &message);
    return message.data;
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
  std::vector<std::string> got_;
};

TEST_F(GenericPubSubTest, PublisherReachesATypedSubscription) {
  const auto publisher = node_->create_generic_publisher("topic", "std_msgs/msg/String", 10);
  const auto subscription =
      node_->create_subscription<String>("topic", 10, [this](const String& message) { got_.push_back(message.data); });
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  publisher->publish(bytes_of("hello"));
  ASSERT_TRUE(spin_until(executor_, [this] { return !got_.empty(); }));
  EXPECT_THAT(got_, ElementsAre("hello"));
}

TEST_F(GenericPubSubTest, SubscriptionGetsWhatATypedPublisherSends) {
  const auto subscription = node_->create_generic_subscription(
      "topic", "std_msgs/msg/String", 10,
      [this](std::shared_ptr<const SerializedMessage> bytes) { got_.push_back(text_of(*bytes)); });
  const auto with_info = node_->create_generic_subscription(
      "topic", "std_msgs/String", 10, [this](const SerializedMessage& bytes, const rclcpp::MessageInfo& info) {
        EXPECT_GT(info.get_rmw_message_info().source_timestamp, 0);
        got_.push_back(text_of(bytes));
      });
  const auto publisher = node_->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 2; }));
  String message;
  message.data = "hello";
  publisher->publish(message);
  ASSERT_TRUE(spin_until(executor_, [this] { return got_.size() == 2; }));
  EXPECT_THAT(got_, ElementsAre("hello", "hello"));
}

TEST_F(GenericPubSubTest, OneGivesToTheOther) {
  const auto publisher = node_->create_generic_publisher("topic", "std_msgs/msg/String", 10);
  const auto subscription = node_->create_generic_subscription(
      "topic", "std_msgs/msg/String", 10,
      [this](std::unique_ptr<SerializedMessage> bytes) { got_.push_back(text_of(*bytes)); });
  EXPECT_STREQ(subscription->get_topic_name(), "/topic");
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  publisher->publish(bytes_of("a"));
  publisher->publish(bytes_of("b"));
  ASSERT_TRUE(spin_until(executor_, [this] { return got_.size() == 2; }));
  EXPECT_THAT(got_, ElementsAre("a", "b"));
}

TEST_F(GenericPubSubTest, LoansWhatIsPlain) {
  const auto plain = node_->create_generic_publisher("plain", "std_msgs/msg/Int64", 10);
  EXPECT_TRUE(plain->can_loan_messages());
  const auto text = node_->create_generic_publisher("text", "std_msgs/msg/String", 10);
  EXPECT_FALSE(text->can_loan_messages());
  try {
    text->publish_as_loaned_msg(bytes_of("a"));
    FAIL() << "no exception";
  } catch (const rclcpp::exceptions::RCLError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("messages on topic '/text' cannot be loaned: their type is not plain"));
  }
  EXPECT_THROW(plain->publish_as_loaned_msg(SerializedMessage()), std::runtime_error);
  rclcpp::shutdown();
  plain->publish_as_loaned_msg(SerializedMessage());  // nowhere, as any message after shutdown
}

TEST_F(GenericPubSubTest, SaysWhyATypeCannotBeFound) {
  const auto error_of = [this](const std::string& type) {
    try {
      node_->create_generic_publisher("topic", type, 10);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no exception");
  };
  for (const char* malformed : {"String", "/msg/String", "std_msgs/msg/", "a/b/c/d"}) {
    EXPECT_EQ(error_of(malformed),
              "Message type '" + std::string(malformed) + "' is not of the form package/type and cannot be processed");
  }
  EXPECT_THAT(error_of("no_such_msgs/msg/String"),
              testing::StartsWith("could not load library 'libno_such_msgs.so': "));
  EXPECT_THAT(error_of("std_msgs/msg/NoSuchType"),
              testing::AllOf(testing::StartsWith("no type 'std_msgs/msg/NoSuchType' in library '"),
                             testing::EndsWith("libstd_msgs.so'")));
}

TEST_F(GenericPubSubTest, TypeSupportsAreThoseOfTheTypes) {
  const auto library = rclcpp::get_typesupport_library("std_msgs/msg/String", "rosidl_typesupport_cpp");
  EXPECT_EQ(rclcpp::get_message_typesupport_handle("std_msgs/msg/String", "rosidl_typesupport_cpp", *library),
            rosidl_typesupport_cpp::get_message_type_support_handle<String>());
  try {
    rclcpp::get_typesupport_library("std_msgs/msg/String", "rosidl_typesupport_introspection_cpp");
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "there is no type support of kind 'rosidl_typesupport_introspection_cpp', only "
                 "'rosidl_typesupport_cpp'");
  }
}

}  // namespace
