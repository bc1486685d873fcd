// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <std_msgs/msg/color_rgba.hpp>
#include <std_msgs/msg/string.hpp>

#include "allocation_count.hpp"
#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using test_support::AllocationCount;
using test_support::Allocations;

constexpr int kWarmUp = 60;
constexpr int kMessages = 100;
// The allocations of Fast DDS 2.9 for a message from writer to reader in one process. More would come from our use of
// it.
constexpr std::size_t kFastDdsPerMessage = 12;

class AllocationTest : public RosTest {
 protected:
  AllocationTest() { executor_.add_node(node_); }

  // Publishes and receives on this thread, because within a process the writer of Fast DDS calls the reader.
  template <typename MessageT>
  Allocations exchange(const MessageT& message) {
    std::size_t received = 0;
    const auto subscription =
        node_->create_subscription<MessageT>("topic", 10, [&received](const MessageT&) { ++received; });
    const auto publisher = node_->create_publisher<MessageT>("topic", 10);
    const auto matched = [&] {
      return publisher->get_subscription_count() == 1 && subscription->get_publisher_count() == 1;
    };
    EXPECT_TRUE(spin_until(executor_, matched));

    const auto exchange_one = [&] {
      const std::size_t before = received;
      publisher->publish(message);
      while (received == before) {
        executor_.spin_once(std::chrono::seconds(1));
      }
    };
    for (int i = 0; i < kWarmUp; ++i) {
      exchange_one();
    }
    AllocationCount count;
    for (int i = 0; i < kMessages; ++i) {
      exchange_one();
    }
    return count.finish();
  }

  static void expect_none(const Allocations& allocations) {
    EXPECT_EQ(allocations.in_stack, 0U) << testing::PrintToString(allocations.stack_callers);
    EXPECT_LE(allocations.in_fast_dds, kFastDdsPerMessage * kMessages);
    RecordProperty("allocations_in_fast_dds", static_cast<int>(allocations.in_fast_dds));
  }

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
};

TEST_F(AllocationTest, CountsThoseOfTheProgram) {
  if (!AllocationCount::is_possible()) {
    GTEST_SKIP() << "skipped, because a sanitizer replaces the allocator";
  }
  AllocationCount count;
  const auto memory = std::make_unique<std::string>(100, 'x');
  const Allocations allocations = count.finish();
  EXPECT_EQ(allocations.in_stack, 2U);
  EXPECT_EQ(allocations.in_fast_dds, 0U);
}

TEST_F(AllocationTest, PublishingAndTakingAPlainMessageAllocatesNothingInTheStack) {
  if (!AllocationCount::is_possible()) {
    GTEST_SKIP() << "skipped, because a sanitizer replaces the allocator";
  }
  expect_none(exchange(std_msgs::msg::ColorRGBA()));
}

TEST_F(AllocationTest, AMessageWithAStringIsReadIntoTheMemoryOfTheLastOne) {
  if (!AllocationCount::is_possible()) {
    GTEST_SKIP() << "skipped, because a sanitizer replaces the allocator";
  }
  std_msgs::msg::String message;
  message.data = std::string(1000, 'x');
  expect_none(exchange(message));
}

}  // namespace
