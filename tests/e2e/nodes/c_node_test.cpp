// SPDX-License-Identifier: Apache-2.0
// A node in C with C messages, and a node of rclcpp in this process that talks with it.
#include <gtest/gtest.h>

#include <chrono>
#include <example_interfaces/srv/add_two_ints.hpp>
#include <future>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <thread>
#include <utility>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using sensor_msgs::msg::JointState;

constexpr std::chrono::seconds kPatience{20};

TEST(NodeInC, TalksWithNodesOfRclcpp) {
  test_support::Sandbox sandbox;
  test_support::RunningCommand program(test_support::Command{{C_NODE}});
  rclcpp::init(0, nullptr);
  {
    const auto node = std::make_shared<rclcpp::Node>("observer");
    const auto publisher = node->create_publisher<JointState>("joints", 10);
    std::promise<JointState> doubled;
    const auto subscription = node->create_subscription<JointState>(
        "doubled", 10, [&doubled, has = false](const JointState& message) mutable {
          if (!std::exchange(has, true)) {
            doubled.set_value(message);
          }
        });
    const auto client = node->create_client<AddTwoInts>("add");
    ASSERT_TRUE(client->wait_for_service(kPatience));
    const auto event = node->get_graph_event();
    while (publisher->get_subscription_count() == 0 || subscription->get_publisher_count() == 0) {
      node->wait_for_graph_change(event, kPatience);
      event->check_and_clear();
    }

    JointState state;
    state.header.frame_id = "base";
    state.header.stamp.sec = 7;
    state.name = {"elbow", "wrist"};
    state.position = {0.5, -1.0};
    // A message that comes before the node has found our subscription is doubled for nobody.
    auto received = doubled.get_future();
    const auto end = std::chrono::steady_clock::now() + kPatience;
    do {
      publisher->publish(state);
    } while (rclcpp::spin_until_future_complete(node, received, std::chrono::milliseconds(200)) ==
                 rclcpp::FutureReturnCode::TIMEOUT &&
             std::chrono::steady_clock::now() < end);
    ASSERT_EQ(received.wait_for(std::chrono::seconds(0)), std::future_status::ready);
    state.name = {"ELBOW", "WRIST"};
    state.position = {1.0, -2.0};
    EXPECT_EQ(received.get(), state);

    auto request = std::make_shared<AddTwoInts::Request>();
    request->a = 40;
    request->b = 2;
    auto answer = client->async_send_request(request);
    ASSERT_EQ(rclcpp::spin_until_future_complete(node, answer, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    EXPECT_EQ(answer.get()->sum, 42);
  }
  const test_support::CommandResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "answered\n");
  rclcpp::shutdown();
}

// The end of the service comes by another port than its answer. This test lets the answer be read late.
TEST(NodeInC, AnswersAlsoIfItEndsAtOnce) {
  test_support::Sandbox sandbox;
  test_support::RunningCommand program(test_support::Command{{C_NODE}});
  rclcpp::init(0, nullptr);
  {
    const auto node = std::make_shared<rclcpp::Node>("observer");
    const auto publisher = node->create_publisher<JointState>("joints", 10);
    const auto subscription = node->create_subscription<JointState>("doubled", 10, [](const JointState&) {});
    const auto client = node->create_client<AddTwoInts>("add");
    ASSERT_TRUE(client->wait_for_service(kPatience));
    // One thread receives messages. This callback holds it up until the service is gone, but at most 100 ms.
    std::promise<void> echoed;
    subscription->set_on_new_message_callback([&, has = false](std::size_t) mutable {
      if (std::exchange(has, true)) {
        return;
      }
      echoed.set_value();
      const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
      while (client->service_is_ready() && std::chrono::steady_clock::now() < end) {
        std::this_thread::yield();
      }
    });
    auto is_echoed = echoed.get_future();
    const auto end = std::chrono::steady_clock::now() + kPatience;
    do {
      publisher->publish(JointState());
    } while (is_echoed.wait_for(std::chrono::milliseconds(200)) == std::future_status::timeout &&
             std::chrono::steady_clock::now() < end);

    auto answer = client->async_send_request(std::make_shared<AddTwoInts::Request>());
    EXPECT_EQ(rclcpp::spin_until_future_complete(node, answer, kPatience), rclcpp::FutureReturnCode::SUCCESS);
    subscription->clear_on_new_message_callback();
  }
  EXPECT_EQ(program.wait().out, "answered\n");
  rclcpp::shutdown();
}

}  // namespace
