// SPDX-License-Identifier: Apache-2.0
// Asks service add_two_ints, or the service in the first argument, for a sum and waits for the answer.
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "example_interfaces/srv/add_two_ints.hpp"
#include "rclcpp/rclcpp.hpp"

using AddTwoInts = example_interfaces::srv::AddTwoInts;

// Returns false if the program is interrupted before the answer has come.
bool ask(const rclcpp::Node::SharedPtr& node, const std::string& service) {
  const auto client = node->create_client<AddTwoInts>(service);
  while (!client->wait_for_service(std::chrono::seconds(1))) {
    if (!rclcpp::ok()) {
      RCLCPP_ERROR(node->get_logger(), "Interrupted while waiting for the service. Exiting.");
      return false;
    }
    RCLCPP_INFO(node->get_logger(), "service not available, waiting again...");
  }
  auto request = std::make_shared<AddTwoInts::Request>();
  request->a = 2;
  request->b = 3;
  auto future = client->async_send_request(request);
  if (rclcpp::spin_until_future_complete(node, future) != rclcpp::FutureReturnCode::SUCCESS) {
    RCLCPP_ERROR(node->get_logger(), "Interrupted while waiting for response. Exiting.");
    return false;
  }
  RCLCPP_INFO(node->get_logger(), "Result of add_two_ints: %" PRId64, future.get()->sum);
  return true;
}

int main(int argc, char** argv) {
  try {
    const auto arguments = rclcpp::init_and_remove_ros_arguments(argc, argv);
    const auto node = std::make_shared<rclcpp::Node>("add_two_ints_client");
    const bool answered = ask(node, arguments.size() > 1 ? arguments[1] : "add_two_ints");
    rclcpp::shutdown();
    return answered ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "add_two_ints_client: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
