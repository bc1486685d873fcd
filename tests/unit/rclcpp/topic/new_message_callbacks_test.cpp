// SPDX-License-Identifier: Apache-2.0
// Callbacks that are told of new messages, requests and responses.
#include <atomic>
#include <chrono>
#include <example_interfaces/srv/add_two_ints.hpp>
#include <memory>
#include <rclcpp/executors.hpp>
#include <std_msgs/msg/string.hpp>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::srv::AddTwoInts;
using rclcpp::experimental::executors::EventsExecutor;
using std_msgs::msg::String;

class NewMessageCallbacks : public RosTest {
 protected:
  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("told");
};

TEST_F(NewMessageCallbacks, LaterCallbacksAreToldOfWhatNoOtherWasToldOf) {
  auto publisher = node_->create_publisher<String>("topic", 10);
  auto subscription = node_->create_subscription<String>("topic", 10, [](const String&) {});
  auto service = node_->create_service<AddTwoInts>(
      "add", [](std::shared_ptr<AddTwoInts::Request>, std::shared_ptr<AddTwoInts::Response>) {});
  auto client = node_->create_client<AddTwoInts>("add");
  ASSERT_TRUE(client->wait_for_service(kPatience));
  std::atomic<size_t> first{0};
  std::atomic<size_t> second{0};
  const auto count_in = [](std::atomic<size_t>& counter) { return [&counter](size_t count) { counter += count; }; };
  const auto wait_for = [](const std::atomic<size_t>& counter, size_t count) {
    const auto give_up = std::chrono::steady_clock::now() + kPatience;
    while (counter < count && std::chrono::steady_clock::now() < give_up) {
      std::this_thread::yield();
    }
    EXPECT_EQ(counter, count);
  };
  subscription->set_on_new_message_callback(count_in(first));
  publisher->publish(String());
  wait_for(first, 1);
  subscription->set_on_new_message_callback(count_in(second));
  EXPECT_EQ(second, 0u);
  publisher->publish(String());
  wait_for(second, 1);
  subscription->clear_on_new_message_callback();
  publisher->publish(String());
  ASSERT_TRUE(publisher->wait_for_all_acked(kPatience));
  second = 0;
  subscription->set_on_new_message_callback(count_in(second));
  wait_for(second, 1);
  EXPECT_EQ(first, 1u);
  subscription->clear_on_new_message_callback();
  // What it was told of and has not executed, an executor hands to the next callback.
  {
    EventsExecutor executor;
    executor.add_node(node_);
    executor.spin_some();  // told of nothing new
    executor.remove_node(node_);
  }
  second = 0;
  subscription->set_on_new_message_callback(count_in(second));
  wait_for(second, 3);

  first = 0;
  second = 0;
  service->set_on_new_request_callback(count_in(first));
  client->async_send_request(std::make_shared<AddTwoInts::Request>());
  wait_for(first, 1);
  service->set_on_new_request_callback(count_in(second));
  EXPECT_EQ(second, 0u);
  client->async_send_request(std::make_shared<AddTwoInts::Request>());
  wait_for(second, 1);
  service->clear_on_new_request_callback();
  for (int i = 0; i < 3; ++i) {
    client->async_send_request(std::make_shared<AddTwoInts::Request>());
  }
  std::atomic<size_t> third{0};
  service->set_on_new_request_callback(count_in(third));
  wait_for(third, 3);
  service->clear_on_new_request_callback();

  first = 0;
  second = 0;
  client->set_on_new_response_callback(count_in(first));
  service->execute();
  wait_for(first, 1);
  client->set_on_new_response_callback(count_in(second));
  EXPECT_EQ(second, 0u);
}

}  // namespace
