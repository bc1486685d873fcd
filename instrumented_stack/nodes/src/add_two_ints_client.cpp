// SPDX-License-Identifier: Apache-2.0
// Asks service add_two_ints for a sum repeatedly, and ends when all answers have come.
//
// Parameters: a, b   the numbers to add (default 2 and 3)
//             count  how often to ask (default 1)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"

using AddTwoInts = example_interfaces::srv::AddTwoInts;

// Returns 0 if every request was answered.
int ask(const rclcpp::Node::SharedPtr& node) {
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = node->declare_parameter("a", 2);
  request->b = node->declare_parameter("b", 3);
  const int64_t count = node->declare_parameter("count", 1);

  const auto client = node->create_client<AddTwoInts>("add_two_ints");
  while (!client->wait_for_service(std::chrono::seconds(1))) {
    if (!rclcpp::ok()) {
      return EXIT_FAILURE;
    }
    RCLCPP_INFO(node->get_logger(), "waiting for service %s", client->get_service_name());
  }
  for (int64_t i = 0; i < count; ++i) {
    auto future = client->async_send_request(request);
    if (rclcpp::spin_until_future_complete(node, future) != rclcpp::FutureReturnCode::SUCCESS) {
      return EXIT_FAILURE;
    }
    RCLCPP_INFO(node->get_logger(), "%ld + %ld = %ld", static_cast<long>(request->a), static_cast<long>(request->b),
                static_cast<long>(future.get()->sum));
  }
  return EXIT_SUCCESS;
}

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    const int result = ask(std::make_shared<rclcpp::Node>("add_two_ints_client"));
    rclcpp::shutdown();
    return result;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "add_two_ints_client: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
