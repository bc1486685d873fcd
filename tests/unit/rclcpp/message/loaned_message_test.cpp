// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <std_msgs/msg/color_rgba.hpp>
#include <std_msgs/msg/float64.hpp>
#include <std_msgs/msg/string.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

using std_msgs::msg::ColorRGBA;
using std_msgs::msg::Float64;
using std_msgs::msg::String;

namespace {

class LoanedMessageTest : public RosTest {
 protected:
  LoanedMessageTest() { executor_.add_node(node_); }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(LoanedMessageTest, APlainMessageIsSentFromWhereItIsMade) {
  std::vector<ColorRGBA> got;
  const auto subscription =
      node_->create_subscription<ColorRGBA>("topic", 10, [&got](const ColorRGBA& message) { got.push_back(message); });
  const auto publisher = node_->create_publisher<ColorRGBA>("topic", 10);
  EXPECT_TRUE(publisher->can_loan_messages());
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  ColorRGBA expected;
  expected.r = 0.25F;
  expected.a = 1.0F;
  for (std::size_t i = 1; i <= 20; ++i) {  // more than the queue holds
    auto loan = publisher->borrow_loaned_message();
    ASSERT_TRUE(loan.is_valid());
    loan.get() = expected;
    publisher->publish(std::move(loan));
    ASSERT_TRUE(spin_until(executor_, [&] { return got.size() == i; }));
    EXPECT_EQ(got.back(), expected);
  }
}

TEST_F(LoanedMessageTest, LoansAreAlignedForTheirMembers) {
  const auto publisher = node_->create_publisher<Float64>("topic", 10);
  const auto loan = publisher->borrow_loaned_message();
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&loan.get()) % alignof(Float64), 0U);
}

TEST_F(LoanedMessageTest, WhatIsNotPublishedGoesBack) {
  const auto publisher = node_->create_publisher<Float64>("topic", 10);
  for (int i = 0; i < 1000; ++i) {
    auto loan = publisher->borrow_loaned_message();
    auto moved = std::move(loan);
    EXPECT_TRUE(moved.is_valid());
  }
}

TEST_F(LoanedMessageTest, OtherMessagesAreOrdinaryOnes) {
  std::string got;
  const auto subscription =
      node_->create_subscription<String>("topic", 10, [&got](const String& message) { got = message.data; });
  const auto publisher = node_->create_publisher<String>("topic", 10);
  EXPECT_FALSE(publisher->can_loan_messages());
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 1; }));
  auto loan = publisher->borrow_loaned_message();
  loan.get().data = "hello";
  publisher->publish(std::move(loan));
  ASSERT_TRUE(spin_until(executor_, [&] { return !got.empty(); }));
  EXPECT_EQ(got, "hello");
}

TEST_F(LoanedMessageTest, ReachesSubscriptionsOfTheProcessToo) {
  const auto near = std::make_shared<rclcpp::Node>("near", rclcpp::NodeOptions().use_intra_process_comms(true));
  executor_.add_node(near);
  double got = 0;
  const auto subscription =
      near->create_subscription<Float64>("topic", 10, [&got](const Float64& message) { got = message.data; });
  const auto publisher = near->create_publisher<Float64>("topic", 10);
  auto loan = publisher->borrow_loaned_message();
  loan.get().data = 2.5;
  publisher->publish(std::move(loan));
  ASSERT_TRUE(spin_until(executor_, [&] { return got != 0; }));
  EXPECT_EQ(got, 2.5);
}

TEST_F(LoanedMessageTest, SubscriptionsTakeLoansOnlyIfTheEnvironmentAllowsThem) {
  const auto nothing = [](const Float64&) {};
  EXPECT_FALSE(node_->create_subscription<Float64>("topic", 10, nothing)->can_loan_messages());
  setenv("ROS_DISABLE_LOANED_MESSAGES", "0", 1);
  EXPECT_TRUE(node_->create_subscription<Float64>("topic", 10, nothing)->can_loan_messages());
  EXPECT_FALSE(node_->create_subscription<String>("topic2", 10, [](const String&) {})->can_loan_messages());
  unsetenv("ROS_DISABLE_LOANED_MESSAGES");
}

TEST_F(LoanedMessageTest, ALoanTakenForAReferenceIsReturnedAfterTheCallback) {
  setenv("ROS_DISABLE_LOANED_MESSAGES", "0", 1);
  std::vector<double> by_reference;
  std::vector<std::shared_ptr<const Float64>> kept;
  const auto referring = node_->create_subscription<Float64>(
      "topic", 1, [&by_reference](const Float64& message) { by_reference.push_back(message.data); });
  // A callback can only keep a copy.
  const auto keeping = node_->create_subscription<Float64>(
      "topic", 1, [&kept](std::shared_ptr<const Float64> message) { kept.push_back(std::move(message)); });
  unsetenv("ROS_DISABLE_LOANED_MESSAGES");
  const auto publisher = node_->create_publisher<Float64>("topic", 10);
  ASSERT_TRUE(spin_until(executor_, [&] { return publisher->get_subscription_count() == 2; }));
  for (int i = 0; i < 20; ++i) {
    auto loan = publisher->borrow_loaned_message();
    loan.get().data = i;
    publisher->publish(std::move(loan));
    const auto count = static_cast<std::size_t>(i + 1);
    ASSERT_TRUE(spin_until(executor_, [&] { return by_reference.size() == count && kept.size() == count; }));
    EXPECT_EQ(by_reference.back(), i);
  }
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(kept[static_cast<std::size_t>(i)]->data, i);
  }
}

TEST_F(LoanedMessageTest, ItIsPublishedOnce) {
  const auto publisher = node_->create_publisher<Float64>("topic", 10);
  auto loan = publisher->borrow_loaned_message();
  publisher->publish(std::move(loan));
  try {
    publisher->publish(std::move(loan));
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "loaned message is not valid");
  }
}

// A callback may borrow while another thread, or a signal, shuts down.
TEST_F(LoanedMessageTest, AfterShutdownItIsAnOrdinaryMessageThatGoesNowhere) {
  const auto publisher = node_->create_publisher<Float64>("topic", 10);
  rclcpp::shutdown();
  auto loan = publisher->borrow_loaned_message();
  ASSERT_TRUE(loan.is_valid());
  loan.get().data = 1;
  publisher->publish(std::move(loan));
}

}  // namespace
