// SPDX-License-Identifier: Apache-2.0
// Where the parts of an action's messages of C++ are in memory, by the description of the action.
#pragma once

#include <cstddef>

#include "rosidl_typesupport_cpp/action_type_support.hpp"

namespace rclcpp_action {

enum class ActionPart { kGoal, kResult, kFeedback };

// Bytes from the beginning of the message that holds the part: of the goal in a request of the service for goals, of
// the result in a response of the service for results, of the feedback in its message. Throws std::runtime_error if the
// type support does not describe the action.
std::size_t offset_of(ActionPart part, const rosidl_action_type_support_t& action);

}  // namespace rclcpp_action
