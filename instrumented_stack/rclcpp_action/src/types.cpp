// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_action/types.hpp"

#include <algorithm>
#include <stdexcept>

namespace rclcpp_action {

std::string to_string(const GoalUUID& goal_id) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < goal_id.size(); ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) {
      text += '-';
    }
    text += kDigits[goal_id[i] >> 4];
    text += kDigits[goal_id[i] & 15];
  }
  return text;
}

void convert(const GoalUUID& goal_id, rcl_action_goal_info_t* info) {
  if (info == nullptr) {
    throw std::invalid_argument("info is nullptr");
  }
  std::copy(goal_id.begin(), goal_id.end(), info->goal_id.uuid);
}

void convert(const rcl_action_goal_info_t& info, GoalUUID* goal_id) {
  if (goal_id == nullptr) {
    throw std::invalid_argument("goal_id is nullptr");
  }
  std::copy(std::begin(info.goal_id.uuid), std::end(info.goal_id.uuid), goal_id->begin());
}

}  // namespace rclcpp_action
