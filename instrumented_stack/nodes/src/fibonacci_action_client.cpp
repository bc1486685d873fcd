// SPDX-License-Identifier: Apache-2.0
// Asks action fibonacci for a sequence, prints the partial sequences, and ends with the result.
//
// Parameters: order         how many numbers after the first (default 10)
//             cancel_after  cancels after this many feedback messages (default 0: never)
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "example_interfaces/action/fibonacci.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_action/rclcpp_action.hpp"

using Fibonacci = example_interfaces::action::Fibonacci;
using Client = rclcpp_action::Client<Fibonacci>;

std::string to_text(const std::vector<int32_t>& sequence) {
  std::string text;
  for (const int32_t number : sequence) {
    text += (text.empty() ? "" : " ") + std::to_string(number);
  }
  return text;
}

const char* to_text(rclcpp_action::ResultCode code) {
  switch (code) {
    case rclcpp_action::ResultCode::SUCCEEDED:
      return "succeeded";
    case rclcpp_action::ResultCode::CANCELED:
      return "was canceled";
    case rclcpp_action::ResultCode::ABORTED:
      return "was aborted";
    case rclcpp_action::ResultCode::UNKNOWN:
      break;
  }
  return "is unknown";
}

// Returns 0 if there is a result.
int compute(const rclcpp::Node::SharedPtr& node) {
  Fibonacci::Goal goal;
  goal.order = static_cast<int32_t>(node->declare_parameter("order", 10));
  const int64_t cancel_after = node->declare_parameter("cancel_after", 0);

  const Client::SharedPtr client = rclcpp_action::create_client<Fibonacci>(node, "fibonacci");
  while (!client->wait_for_action_server(std::chrono::seconds(1))) {
    if (!rclcpp::ok()) {
      return EXIT_FAILURE;
    }
    RCLCPP_INFO(node->get_logger(), "waiting for the server of action fibonacci");
  }

  Client::SendGoalOptions options;
  options.feedback_callback = [&, received = int64_t{0}](Client::GoalHandle::SharedPtr handle,
                                                         std::shared_ptr<const Fibonacci::Feedback> feedback) mutable {
    RCLCPP_INFO(node->get_logger(), "Feedback: %s", to_text(feedback->sequence).c_str());
    if (++received == cancel_after) {
      client->async_cancel_goal(handle);
    }
  };
  const auto accepted = client->async_send_goal(goal, options);
  if (rclcpp::spin_until_future_complete(node, accepted) != rclcpp::FutureReturnCode::SUCCESS) {
    return EXIT_FAILURE;
  }
  const Client::GoalHandle::SharedPtr& handle = accepted.get();
  if (!handle) {
    RCLCPP_ERROR(node->get_logger(), "Goal was rejected by server");
    return EXIT_FAILURE;
  }
  const auto result = client->async_get_result(handle);
  if (rclcpp::spin_until_future_complete(node, result) != rclcpp::FutureReturnCode::SUCCESS) {
    return EXIT_FAILURE;
  }
  RCLCPP_INFO(node->get_logger(), "Goal %s: %s", to_text(result.get().code),
              to_text(result.get().result->sequence).c_str());
  return EXIT_SUCCESS;
}

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    const int result = compute(std::make_shared<rclcpp::Node>("fibonacci_action_client"));
    rclcpp::shutdown();
    return result;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fibonacci_action_client: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
