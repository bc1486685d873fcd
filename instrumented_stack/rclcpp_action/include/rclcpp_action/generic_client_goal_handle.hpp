// SPDX-License-Identifier: Apache-2.0
// A goal that a server has accepted, on the side of a client that knows the type of its action by name only.
#pragma once

#include <memory>

#include "rclcpp/macros.hpp"
#include "rclcpp_action/client_goal_handle.hpp"
#include "rclcpp_action/detail/goal_of_client.hpp"

namespace rclcpp_action {

class GenericClientGoalHandle;

namespace detail {

struct GenericResult {
  GoalUUID goal_id{};
  ResultCode code = ResultCode::UNKNOWN;
  const void* result = nullptr;           // the Result of the action, in result_response
  std::shared_ptr<void> result_response;  // owns it
};

// Feedback callbacks get the Feedback of the action. It lives until they return.
using GenericGoal = GoalOfClient<GenericClientGoalHandle, GenericResult, const void*>;

}  // namespace detail

// What a goal of an action tells: detail::GoalOfClient.
class GenericClientGoalHandle : public detail::GenericGoal {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(GenericClientGoalHandle)

  using ResultCode = rclcpp_action::ResultCode;
  using WrappedResult = detail::GenericResult;

 private:
  using Base = detail::GenericGoal;
  using Base::Base;
};

}  // namespace rclcpp_action
