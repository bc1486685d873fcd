// SPDX-License-Identifier: Apache-2.0
// Identities and states of goals.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "action_msgs/msg/goal_info.hpp"
#include "action_msgs/msg/goal_status.hpp"
#include "rcl_action/types.h"

namespace rclcpp_action {

using GoalUUID = std::array<uint8_t, UUID_SIZE>;
using GoalStatus = action_msgs::msg::GoalStatus;
using GoalInfo = action_msgs::msg::GoalInfo;

// Hexadecimal, with dashes after 4, 6, 8 and 10 bytes.
std::string to_string(const GoalUUID& goal_id);

void convert(const GoalUUID& goal_id, rcl_action_goal_info_t* info);
void convert(const rcl_action_goal_info_t& info, GoalUUID* goal_id);

}  // namespace rclcpp_action

// std::less needs no specialisation.
template <>
struct std::hash<rclcpp_action::GoalUUID> {
  std::size_t operator()(const rclcpp_action::GoalUUID& goal_id) const noexcept {
    std::size_t result = 0;
    for (const uint8_t byte : goal_id) {
      result = result * 31 + byte;
    }
    return result;
  }
};
