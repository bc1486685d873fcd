// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_action/server_goal_handle.hpp"

#include <string>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp_action {

ServerGoalHandleBase::~ServerGoalHandleBase() = default;

rcl_action_goal_state_t ServerGoalHandleBase::state() const {
  rcl_action_goal_state_t state = GOAL_STATE_UNKNOWN;
  rclcpp::detail::require_ok(rcl_action_goal_handle_get_status(rcl_handle_.get(), &state),
                             "failed to get the status of a goal");
  return state;
}

bool ServerGoalHandleBase::is_canceling() const {
  return state() == GOAL_STATE_CANCELING;
}

bool ServerGoalHandleBase::is_active() const {
  return rcl_action_goal_handle_is_active(rcl_handle_.get());
}

bool ServerGoalHandleBase::is_executing() const {
  return state() == GOAL_STATE_EXECUTING;
}

void ServerGoalHandleBase::update(rcl_action_goal_event_t event, const char* what) {
  const rcl_ret_t ret = rcl_action_update_goal_state(rcl_handle_.get(), event);
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, std::string("the goal could not ") + what);
  }
}

void ServerGoalHandleBase::note_untold_end(const std::exception& error) {
  RCLCPP_DEBUG(rclcpp::get_logger("rclcpp_action"), "could not tell that a goal was given up: %s", error.what());
}

bool ServerGoalHandleBase::try_canceling() noexcept {
  rcl_action_goal_handle_t* goal = rcl_handle_.get();
  if (!rcl_action_goal_handle_is_active(goal)) {
    return false;
  }
  if (rcl_action_goal_handle_is_cancelable(goal) &&
      rcl_action_update_goal_state(goal, GOAL_EVENT_CANCEL_GOAL) != RCL_RET_OK) {
    return false;
  }
  return rcl_action_update_goal_state(goal, GOAL_EVENT_CANCELED) == RCL_RET_OK;
}

}  // namespace rclcpp_action
