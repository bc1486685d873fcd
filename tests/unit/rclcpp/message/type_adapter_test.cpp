// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <memory>
#include <rclcpp/type_adapter.hpp>
#include <std_msgs/msg/string.hpp>
#include <string>

#include "tests/unit/rclcpp/ros_test.hpp"

using std_msgs::msg::String;
using testing::ElementsAre;

namespace {

int conversions = 0;

}  // namespace

template <>
struct rclcpp::TypeAdapter<std::string, String> {
  using is_specialized = std::true_type;
  using custom_type = std::string;
  using ros_message_type = String;

  static void convert_to_ros_message(const custom_type& source, ros_message_type& destination) {
    destination.data = source;
    ++conversions;
  }
  static void convert_to_custom(const ros_message_type& source, custom_type& destination) {
    destination = source.data;
    ++conversions;
  }
};

struct Sentence {
  std::string words;
};

template <>
struct rclcpp::TypeAdapter<Sentence, String> {
  using is_specialized = std::true_type;
  using custom_type = Sentence;
  using ros_message_type = String;

  static void convert_to_ros_message(const custom_type& source, ros_message_type& destination) {
    destination.data = source.words;
  }
  static void convert_to_custom(const ros_message_type& source, custom_type& destination) {
    destination.words = source.data;
  }
};
RCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE(Sentence, String);

namespace {

using Adapted = rclcpp::adapt_type<std::string>::as<String>;

class TypeAdapterTest : public RosTest, public testing::WithParamInterface<bool> {
 protected:
  TypeAdapterTest() {
    executor_.add_node(node_);
    conversions = 0;
  }

  // The result of `callback`, which calls got(), for a message of the custom type and for one of the message type.
  template <typename CallbackT>
  void expect_both(CallbackT callback) {
    got_.clear();
    const auto subscription = node_->create_subscription<Adapted>("topic", 10, callback);
    const auto publisher = node_->create_publisher<Adapted>("topic", 10);
    ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
    publisher->publish(std::string("a"));
    publisher->publish(std::make_unique<std::string>("b"));
    String message;
    message.data = "c";
    publisher->publish(message);
    publisher->publish(std::make_unique<String>(message));
    ASSERT_TRUE(spin_until(executor_, [this] { return got_.size() == 4; }));
    EXPECT_THAT(got_, ElementsAre("a", "b", "c", "c"));
  }

  rclcpp::Node::SharedPtr node_ =
      std::make_shared<rclcpp::Node>("node", rclcpp::NodeOptions().use_intra_process_comms(GetParam()));
  rclcpp::executors::SingleThreadedExecutor executor_;
  std::vector<std::string> got_;
};

INSTANTIATE_TEST_SUITE_P(IntraProcess, TypeAdapterTest, testing::Bool());

TEST_P(TypeAdapterTest, CallbacksTakeTheCustomType) {
  expect_both([this](const std::string& text) { got_.push_back(text); });
  expect_both([this](std::shared_ptr<const std::string> text) { got_.push_back(*text); });
  expect_both([this](std::unique_ptr<std::string> text) { got_.push_back(*text); });
  expect_both([this](std::shared_ptr<std::string> text, const rclcpp::MessageInfo&) { got_.push_back(*text); });
}

TEST_P(TypeAdapterTest, CallbacksTakeTheMessageType) {
  expect_both([this](const String& message) { got_.push_back(message.data); });
  expect_both([this](String::ConstSharedPtr message) { got_.push_back(message->data); });
  expect_both([this](String::UniquePtr message) { got_.push_back(message->data); });
  expect_both([this](String::SharedPtr message) { got_.push_back(message->data); });
}

TEST_P(TypeAdapterTest, TheCustomTypeIsConvertedOnlyForTheMiddleware) {
  int received = 0;
  const auto subscription = node_->create_subscription<Adapted>("topic", 10, [&](const std::string&) { ++received; });
  const auto publisher = node_->create_publisher<Adapted>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  publisher->publish(std::make_unique<std::string>("a"));
  ASSERT_TRUE(spin_until(executor_, [&] { return received == 1; }));
  EXPECT_EQ(conversions, GetParam() ? 0 : 2);
}

TEST_P(TypeAdapterTest, ATypeMayStandForItsMessageEverywhere) {
  const auto subscription =
      node_->create_subscription<Sentence>("topic", 10, [this](const Sentence& s) { got_.push_back(s.words); });
  const auto plain =
      node_->create_subscription<String>("topic", 10, [this](const String& message) { got_.push_back(message.data); });
  const auto publisher = node_->create_publisher<Sentence>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 2; }));
  publisher->publish(Sentence{"so it is"});
  ASSERT_TRUE(spin_until(executor_, [this] { return got_.size() == 2; }));
  EXPECT_THAT(got_, ElementsAre("so it is", "so it is"));
}

}  // namespace
