// SPDX-License-Identifier: Apache-2.0
// The exceptions that clients throw about goals.
#pragma once

#include <stdexcept>
#include <string>

namespace rclcpp_action::exceptions {

// The goal does not, or no longer, belong to the client.
class UnknownGoalHandleError : public std::invalid_argument {
 public:
  UnknownGoalHandleError() : std::invalid_argument("Goal handle is not known to this client.") {}
};

// The result of the goal was not requested.
class UnawareGoalHandleError : public std::runtime_error {
 public:
  explicit UnawareGoalHandleError(
      const std::string& message = "Goal handle is not tracking the goal result because its result was not requested.")
      : std::runtime_error(message) {}
};

}  // namespace rclcpp_action::exceptions
