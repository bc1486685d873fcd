// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <std_msgs/msg/string.hpp>
#include <string>
#include <vector>

#include "tests/support/emulated.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

using rclcpp::MessageInfo;
using rclcpp::SerializedMessage;
using std_msgs::msg::String;

namespace {

std::string text_of(const SerializedMessage& bytes) {
  String message;
  rclcpp::Serialization<String>().deserialize_message(&bytes, &message);
  return message.data;
}

String message_with(const std::string& text) {
  String message;
  message.data = text;
  return message;
}

class PubSubTest : public RosTest {
 protected:
  PubSubTest() { executor_.add_node(node_); }

  // The result of a subscription with this callback for one message; the callback calls got().
  template <typename CallbackT>
  void expect_delivery(CallbackT callback) {
    got_.clear();
    auto subscription = node_->create_subscription<String>("topic", 10, callback);
    auto publisher = node_->create_publisher<String>("topic", 10);
    ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
    ASSERT_TRUE(spin_until(executor_, [&] { return subscription->get_publisher_count() == 1; }));
    publisher->publish(message_with("hello"));
    ASSERT_TRUE(spin_until(executor_, [&] { return !got_.empty(); }));
    EXPECT_EQ(got_, "hello");
  }

  void got(const std::string& text, const MessageInfo* info = nullptr) {
    got_ = text;
    if (info) {
      EXPECT_GT(info->get_rmw_message_info().source_timestamp, 0);
      EXPECT_FALSE(info->get_rmw_message_info().from_intra_process);
    }
  }

 public:
  void method(const String& message) { got(message.data); }
  void method_with_info(std::shared_ptr<const String> message, const MessageInfo& info) { got(message->data, &info); }

 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
  std::string got_;
};

std::string* g_function_got = nullptr;
void plain_function(const String& message) {
  *g_function_got = message.data;
}

TEST_F(PubSubTest, DeliversByReference) {
  expect_delivery([this](const String& message) { got(message.data); });
}
TEST_F(PubSubTest, DeliversByReferenceWithInfo) {
  expect_delivery([this](const String& message, const MessageInfo& info) { got(message.data, &info); });
}
TEST_F(PubSubTest, DeliversByValue) {
  expect_delivery([this](String message) { got(message.data); });
}
TEST_F(PubSubTest, DeliversUnique) {
  expect_delivery([this](std::unique_ptr<String> message) { got(message->data); });
}
TEST_F(PubSubTest, DeliversUniqueWithInfo) {
  expect_delivery([this](String::UniquePtr message, const MessageInfo& info) { got(message->data, &info); });
}
TEST_F(PubSubTest, DeliversSharedConst) {
  expect_delivery([this](std::shared_ptr<const String> message) { got(message->data); });
}
TEST_F(PubSubTest, DeliversSharedConstByReferenceWithInfo) {
  expect_delivery(
      [this](const String::ConstSharedPtr& message, const MessageInfo& info) { got(message->data, &info); });
}
TEST_F(PubSubTest, DeliversShared) {
  expect_delivery([this](std::shared_ptr<String> message) { got(message->data); });
}
TEST_F(PubSubTest, DeliversSharedWithInfo) {
  expect_delivery([this](std::shared_ptr<String> message, const MessageInfo& info) { got(message->data, &info); });
}
TEST_F(PubSubTest, DeliversToBoundMethods) {
  using std::placeholders::_1;
  using std::placeholders::_2;
  expect_delivery(std::bind(&PubSubTest::method, static_cast<PubSubTest*>(this), _1));
  expect_delivery(std::bind(&PubSubTest::method_with_info, static_cast<PubSubTest*>(this), _1, _2));
}
TEST_F(PubSubTest, DeliversToAPlainFunction) {
  g_function_got = &got_;
  expect_delivery(plain_function);
  expect_delivery(std::function<void(const String&)>(plain_function));
}
TEST_F(PubSubTest, DeliversSerialized) {
  expect_delivery([this](const SerializedMessage& bytes) { got(text_of(bytes)); });
  expect_delivery([this](std::shared_ptr<const SerializedMessage> bytes) { got(text_of(*bytes)); });
  expect_delivery(
      [this](std::shared_ptr<SerializedMessage> bytes, const MessageInfo& info) { got(text_of(*bytes), &info); });
  expect_delivery([this](std::unique_ptr<SerializedMessage> bytes) { got(text_of(*bytes)); });
}

TEST_F(PubSubTest, KeepsASharedMessageUnchangedAfterTheCallback) {
  std::vector<String::ConstSharedPtr> kept;
  auto subscription = node_->create_subscription<String>(
      "topic", 10, [&kept](String::ConstSharedPtr message) { kept.push_back(message); });
  auto publisher = node_->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  publisher->publish(message_with("a"));
  publisher->publish(message_with("b"));
  ASSERT_TRUE(spin_until(executor_, [&] { return kept.size() == 2; }));
  EXPECT_EQ(kept[0]->data, "a");
  EXPECT_EQ(kept[1]->data, "b");
}

TEST_F(PubSubTest, PublishesUniqueAndSerializedMessages) {
  std::vector<std::string> texts;
  auto subscription = node_->create_subscription<String>(
      "topic", 10, [&texts](const String& message) { texts.push_back(message.data); });
  auto publisher = node_->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  publisher->publish(std::make_unique<String>(message_with("unique")));
  const String message = message_with("bytes");
  SerializedMessage bytes;
  rclcpp::Serialization<String>().serialize_message(&message, &bytes);
  publisher->publish(bytes);
  ASSERT_TRUE(spin_until(executor_, [&] { return texts.size() == 2; }));
  EXPECT_EQ(texts, (std::vector<std::string>{"unique", "bytes"}));
  EXPECT_TRUE(publisher->wait_for_all_acked(kPatience));
}

TEST_F(PubSubTest, LateSubscribersGetTransientLocalMessages) {
  const auto qos = rclcpp::QoS(1).transient_local();
  auto publisher = node_->create_publisher<String>("latched", qos);
  publisher->publish(message_with("old"));
  publisher->publish(message_with("new"));
  auto subscription =
      node_->create_subscription<String>("latched", qos, [this](const String& message) { got(message.data); });
  ASSERT_TRUE(spin_until(executor_, [&] { return !got_.empty(); }));
  EXPECT_EQ(got_, "new");
}

TEST_F(PubSubTest, IgnoresLocalPublicationsOnRequest) {
  rclcpp::SubscriptionOptions options;
  options.ignore_local_publications = true;
  int ignored = 0;
  int received = 0;
  auto deaf = node_->create_subscription<String>(
      "topic", 10, [&ignored](const String&) { ++ignored; }, options);
  auto hearing = node_->create_subscription<String>("topic", 10, [&received](const String&) { ++received; });
  auto publisher = node_->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 2; }));
  publisher->publish(message_with("x"));
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  ASSERT_TRUE(spin_until(executor_, [&] { return received == 1; }));
  executor_.spin_all(std::chrono::nanoseconds(0));
  EXPECT_EQ(ignored, 0);
}

TEST_F(PubSubTest, TakeWorksWithoutACallback) {
  auto group = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  rclcpp::SubscriptionOptions options;
  options.callback_group = group;
  auto subscription = node_->create_subscription<String>(
      "topic", 10, [](const String&) { FAIL(); }, options);
  auto publisher = node_->create_publisher<String>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  String message;
  MessageInfo info;
  EXPECT_FALSE(subscription->take(message, info));
  publisher->publish(message_with("taken"));
  ASSERT_TRUE(spin_until(executor_, [&] { return subscription->take(message, info); }));
  EXPECT_EQ(message.data, "taken");
}

TEST_F(PubSubTest, KnowsNamesQueuesQosAndCounts) {
  auto named = std::make_shared<rclcpp::Node>("inner", "/outer");
  auto publisher = named->create_publisher<String>("~/topic", rclcpp::QoS(3).best_effort());
  EXPECT_STREQ(publisher->get_topic_name(), "/outer/inner/topic");
  EXPECT_EQ(publisher->get_queue_size(), 3u);
  EXPECT_EQ(publisher->get_actual_qos().reliability(), rclcpp::ReliabilityPolicy::BestEffort);
  EXPECT_EQ(named->count_publishers("~/topic"), 1u);
  EXPECT_EQ(named->count_subscribers("~/topic"), 0u);
  auto subscription = named->create_subscription<String>("~/topic", rclcpp::SensorDataQoS(), [](const String&) {});
  EXPECT_STREQ(subscription->get_topic_name(), "/outer/inner/topic");
  EXPECT_TRUE(spin_until(executor_, [&] { return node_->count_subscribers("/outer/inner/topic") == 1; }));
  EXPECT_THAT(node_->get_node_names(), testing::UnorderedElementsAre("/node", "/outer/inner"));
  EXPECT_THAT(node_->get_topic_names_and_types()["/outer/inner/topic"], testing::ElementsAre("std_msgs/msg/String"));
}

TEST_F(PubSubTest, TellsWhereInTheNetworkItSendsAndListens) {
  NEEDS_NETWORK_DEVICES();
  const auto subscription = node_->create_subscription<String>("topic", 10, [](const String&) {});
  const auto endpoints = subscription->get_network_flow_endpoints();
  const auto udp = std::find_if(endpoints.begin(), endpoints.end(),
                                [](const auto& endpoint) { return endpoint.transport_protocol() == "UDP"; });
  ASSERT_NE(udp, endpoints.end());
  EXPECT_EQ(udp->internet_protocol(), "IPv4");
  EXPECT_GT(udp->transport_port(), 7400);  // ports of DDS begin here
  EXPECT_THAT(udp->internet_address(), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_EQ(*udp, *udp);
  EXPECT_THAT(testing::PrintToString(*udp), testing::StartsWith("{\"transportProtocol\": \"UDP\", "));
  EXPECT_FALSE(node_->create_publisher<String>("topic", 10)->get_network_flow_endpoints().empty());
}

TEST_F(PubSubTest, ShowsWhereATopicNameIsWrong) {
  try {
    node_->create_publisher<String>("bad topic", 10);
    FAIL() << "no exception";
  } catch (const rclcpp::exceptions::InvalidTopicNameError& error) {
    EXPECT_EQ(error.name, "bad topic");
    EXPECT_EQ(error.invalid_index, 3u);
    EXPECT_THAT(error.what(), testing::EndsWith(":\n  'bad topic'\n      ^\n"));
  }
  EXPECT_THROW(node_->create_subscription<String>("", 10, [](const String&) {}),
               rclcpp::exceptions::InvalidTopicNameError);
}

TEST_F(PubSubTest, RemapsTopicsByTheCommandLine) {
  auto remapped = std::make_shared<rclcpp::Node>(
      "node2", rclcpp::NodeOptions().arguments({"--ros-args", "-r", "chatter:=/news", "-r", "__ns:=/there"}));
  EXPECT_STREQ(remapped->create_publisher<String>("chatter", 10)->get_topic_name(), "/news");
  EXPECT_STREQ(remapped->create_publisher<String>("other", 10)->get_topic_name(), "/there/other");
}

TEST_F(PubSubTest, PublishingAfterShutdownDoesNothing) {
  auto publisher = node_->create_publisher<String>("topic", 10);
  rclcpp::shutdown();
  EXPECT_NO_THROW(publisher->publish(message_with("late")));
  EXPECT_EQ(publisher->get_subscription_count(), 0u);
}

// Messages that come meanwhile are taken and forgotten, also those of the same process.
TEST_F(PubSubTest, ASubscriptionMayHaveNoCallbacksForAWhile) {
  for (const bool is_intra_process : {false, true}) {
    const auto node = std::make_shared<rclcpp::Node>(is_intra_process ? "intra" : "inter",
                                                     rclcpp::NodeOptions().use_intra_process_comms(is_intra_process));
    executor_.add_node(node);
    std::vector<std::string> received;
    const auto subscription = node->create_subscription<String>(
        "switched", 10, [&received](const String& message) { received.push_back(message.data); });
    int others = 0;
    const auto other = node->create_subscription<String>("switched", 10, [&others](const String&) { ++others; });
    const auto publisher = node->create_publisher<String>("switched", 10);
    ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 2; }));
    subscription->disable_callbacks();
    publisher->publish(message_with("unheard"));
    ASSERT_TRUE(spin_until(executor_, [&] { return others == 1; }));
    executor_.spin_all(std::chrono::seconds(0));
    subscription->enable_callbacks();
    publisher->publish(message_with("heard"));
    ASSERT_TRUE(spin_until(executor_, [&] { return !received.empty(); }));
    EXPECT_EQ(received, std::vector<std::string>{"heard"});
    executor_.remove_node(node);
  }
}

}  // namespace
