// SPDX-License-Identifier: Apache-2.0
// Content filters: the messages that a subscription gets, and changes of the filter while it is used.
#include <gmock/gmock.h>

#include <algorithm>
#include <rcl_interfaces/msg/log.hpp>
#include <std_msgs/msg/float64_multi_array.hpp>
#include <std_msgs/msg/header.hpp>
#include <std_msgs/msg/int32.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using std_msgs::msg::Int32;
using testing::ElementsAre;
using testing::HasSubstr;
using Parameters = std::vector<std::string>;

class ContentFilter : public RosTest {
 protected:
  ContentFilter() { executor_.add_node(node_); }

  static rclcpp::SubscriptionOptions filtered_by(const std::string& expression, const Parameters& parameters = {}) {
    rclcpp::SubscriptionOptions options;
    options.content_filter_options.filter_expression = expression;
    options.content_filter_options.expression_parameters = parameters;
    return options;
  }

  rclcpp::Subscription<Int32>::SharedPtr subscribe(const rclcpp::SubscriptionOptions& options) {
    return node_->create_subscription<Int32>(
        "topic", 20, [this](const Int32& message) { received_.push_back(message.data); }, options);
  }

  // Publishes 0 to 9, and 100, which every filter of these tests lets through. Returns which of 0 to 9 arrived.
  std::vector<int32_t> send_and_receive() {
    EXPECT_TRUE(spin_until(executor_, [this] { return publisher_->get_subscription_count() == 1; }));
    received_.clear();
    Int32 message;
    for (message.data = 0; message.data < 10; ++message.data) {
      publisher_->publish(message);
    }
    message.data = 100;
    publisher_->publish(message);
    EXPECT_TRUE(spin_until(executor_, [this] { return !received_.empty() && received_.back() == 100; }));
    received_.erase(std::find(received_.begin(), received_.end(), 100), received_.end());
    return received_;
  }

  // A publisher, which filters too, learns of a change a little later.
  bool comes_to_receive(const std::vector<int32_t>& expected) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (send_and_receive() != expected) {
      if (HasFailure() || std::chrono::steady_clock::now() > deadline) {
        return false;
      }
    }
    return true;
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::Publisher<Int32>::SharedPtr publisher_ = node_->create_publisher<Int32>("topic", 20);
  rclcpp::executors::SingleThreadedExecutor executor_;
  std::vector<int32_t> received_;
};

TEST_F(ContentFilter, LetsOnlyWantedMessagesThrough) {
  const auto subscription = subscribe(filtered_by("data = %0 OR data > %1", {"3", "7"}));
  EXPECT_TRUE(subscription->is_cft_supported());
  EXPECT_TRUE(subscription->is_cft_enabled());
  EXPECT_TRUE(comes_to_receive({3, 8, 9})) << testing::PrintToString(received_);
  const rclcpp::ContentFilterOptions filter = subscription->get_content_filter();
  EXPECT_EQ(filter.filter_expression, "data = %0 OR data > %1");
  EXPECT_THAT(filter.expression_parameters, ElementsAre("3", "7"));
}

TEST_F(ContentFilter, ChangesAtRunTime) {
  const auto subscription = subscribe(filtered_by("data > %0", {"7"}));
  EXPECT_TRUE(comes_to_receive({8, 9})) << testing::PrintToString(received_);
  subscription->set_content_filter("data > %0", {"6"});
  EXPECT_TRUE(comes_to_receive({7, 8, 9})) << testing::PrintToString(received_);
  subscription->set_content_filter("data BETWEEN %0 AND %1 OR data = 100", {"2", "3"});
  EXPECT_TRUE(comes_to_receive({2, 3})) << testing::PrintToString(received_);
}

TEST_F(ContentFilter, ComesAndGoesAtRunTime) {
  const auto subscription = subscribe({});
  EXPECT_FALSE(subscription->is_cft_enabled());
  EXPECT_THROW(subscription->get_content_filter(), rclcpp::exceptions::RCLError);
  EXPECT_TRUE(comes_to_receive({0, 1, 2, 3, 4, 5, 6, 7, 8, 9})) << testing::PrintToString(received_);

  subscription->set_content_filter("data >= 8");
  EXPECT_TRUE(subscription->is_cft_enabled());
  EXPECT_TRUE(comes_to_receive({8, 9})) << testing::PrintToString(received_);
  EXPECT_EQ(node_->count_subscribers("topic"), 1u);

  subscription->set_content_filter("");
  EXPECT_FALSE(subscription->is_cft_enabled());
  EXPECT_TRUE(comes_to_receive({0, 1, 2, 3, 4, 5, 6, 7, 8, 9})) << testing::PrintToString(received_);
  EXPECT_EQ(node_->count_subscribers("topic"), 1u);
  EXPECT_THROW(subscription->set_content_filter(""), rclcpp::exceptions::RCLError);
}

TEST_F(ContentFilter, SeesFieldsOfMessagesWithinAndText) {
  std::vector<std::string> received;
  const auto subscription = node_->create_subscription<std_msgs::msg::Header>(
      "headers", 10, [&](const std_msgs::msg::Header& message) { received.push_back(message.frame_id); },
      filtered_by("stamp.sec > %0 AND frame_id LIKE %1", {"5", "'base%'"}));
  const auto publisher = node_->create_publisher<std_msgs::msg::Header>("headers", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  std_msgs::msg::Header message;
  const std::pair<int32_t, const char*> messages[] = {{9, "map"}, {1, "base_link"}, {9, "base_link"}, {9, "base"}};
  for (const auto& [sec, frame] : messages) {
    message.stamp.sec = sec;
    message.frame_id = frame;
    publisher->publish(message);
  }
  ASSERT_TRUE(spin_until(executor_, [&] { return received.size() == 2; }));
  EXPECT_THAT(received, ElementsAre("base_link", "base"));
}

TEST_F(ContentFilter, ReadsLongTextAndLongSequencesBeforeTheField) {
  using rcl_interfaces::msg::Log;
  std::vector<uint32_t> lines;
  const auto subscription = node_->create_subscription<Log>(
      "log", 10, [&](const Log& message) { lines.push_back(message.line); }, filtered_by("line > 1"));
  const auto publisher = node_->create_publisher<Log>("log", 10);
  using std_msgs::msg::Float64MultiArray;
  std::vector<size_t> sizes;
  const auto array_subscription = node_->create_subscription<Float64MultiArray>(
      "arrays", 10, [&](const Float64MultiArray& message) { sizes.push_back(message.data.size()); },
      filtered_by("data[1] > 0.5"));
  const auto array_publisher = node_->create_publisher<Float64MultiArray>("arrays", 10);
  ASSERT_TRUE(spin_until(executor_, [&] {
    return publisher->get_subscription_count() == 1 && array_publisher->get_subscription_count() == 1;
  }));
  Log message;
  message.msg = std::string(5000, 'x');
  for (message.line = 1; message.line <= 2; ++message.line) {
    publisher->publish(message);
  }
  Float64MultiArray array;
  array.data.assign(1000, 0.0);
  array_publisher->publish(array);
  array.data.assign(999, 1.0);
  array_publisher->publish(array);
  ASSERT_TRUE(spin_until(executor_, [&] { return !lines.empty() && !sizes.empty(); }));
  EXPECT_THAT(lines, ElementsAre(2));
  EXPECT_THAT(sizes, ElementsAre(999));
}

TEST_F(ContentFilter, ThatDoesNotFitTheMessagesIsAnException) {
  for (const char* expression : {"size > 3", "data >", "data > %0", "data = 'text'"}) {
    try {
      subscribe(filtered_by(expression));
      ADD_FAILURE() << expression;
    } catch (const rclcpp::exceptions::RCLError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr("could not create subscription on 'topic': the content filter '" + std::string(expression) +
                            "' with 0 parameters is not valid for messages of type "
                            "'std_msgs::msg::dds_::Int32_'"));
    }
  }
  const auto subscription = subscribe(filtered_by("data > 7"));
  EXPECT_THROW(subscription->set_content_filter("size > 3"), rclcpp::exceptions::RCLError);
  EXPECT_EQ(subscription->get_content_filter().filter_expression, "data > 7");
  EXPECT_TRUE(comes_to_receive({8, 9})) << testing::PrintToString(received_);
}

TEST_F(ContentFilter, WorksBesideIntraProcessCommunication) {
  node_ = std::make_shared<rclcpp::Node>("within", rclcpp::NodeOptions().use_intra_process_comms(true));
  executor_.add_node(node_);
  publisher_ = node_->create_publisher<Int32>("topic", 20);
  const auto filtered = subscribe(filtered_by("data > 7"));
  EXPECT_TRUE(comes_to_receive({8, 9})) << testing::PrintToString(received_);
  const auto all = node_->create_subscription<Int32>("topic", 20, [](std::unique_ptr<Int32>) {});
  EXPECT_THROW(all->set_content_filter("data > 7"), rclcpp::exceptions::RCLError);
}

// Executed by one thread while another changes the filter.
TEST_F(ContentFilter, MayChangeWhileMessagesAreTaken) {
  const auto subscription = subscribe({});
  rclcpp::executors::MultiThreadedExecutor executor(rclcpp::ExecutorOptions(), 2);
  executor_.remove_node(node_);
  executor.add_node(node_);
  std::atomic<int> ticks{0};
  const auto timer = node_->create_wall_timer(std::chrono::milliseconds(1), [&] {
    publisher_->publish(Int32());
    ++ticks;
  });
  std::thread spinner([&] { executor.spin(); });
  for (int i = 0; i < 50; ++i) {
    const int before = ticks;
    subscription->set_content_filter("data > 7");
    subscription->set_content_filter("");
    while (ticks == before) {
      std::this_thread::yield();
    }
  }
  executor.cancel();
  spinner.join();
  executor.remove_node(node_);
  executor_.add_node(node_);
  timer->cancel();
  EXPECT_TRUE(comes_to_receive({0, 1, 2, 3, 4, 5, 6, 7, 8, 9})) << testing::PrintToString(received_);
}

}  // namespace
