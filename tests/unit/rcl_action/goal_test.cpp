// SPDX-License-Identifier: Apache-2.0
// The states of goals, and the names of the services and topics of an action.
#include <gmock/gmock.h>
#include <rcl/error_handling.h>
#include <rcl_action/rcl_action.h>

#include <map>
#include <string>

namespace {

using testing::UnorderedElementsAreArray;

TEST(GoalStateMachine, AllowsTheTransitionsOfRos2) {
  const std::map<std::pair<rcl_action_goal_state_t, rcl_action_goal_event_t>, rcl_action_goal_state_t> allowed = {
      {{GOAL_STATE_ACCEPTED, GOAL_EVENT_EXECUTE}, GOAL_STATE_EXECUTING},
      {{GOAL_STATE_ACCEPTED, GOAL_EVENT_CANCEL_GOAL}, GOAL_STATE_CANCELING},
      {{GOAL_STATE_EXECUTING, GOAL_EVENT_CANCEL_GOAL}, GOAL_STATE_CANCELING},
      {{GOAL_STATE_EXECUTING, GOAL_EVENT_SUCCEED}, GOAL_STATE_SUCCEEDED},
      {{GOAL_STATE_EXECUTING, GOAL_EVENT_ABORT}, GOAL_STATE_ABORTED},
      {{GOAL_STATE_CANCELING, GOAL_EVENT_SUCCEED}, GOAL_STATE_SUCCEEDED},
      {{GOAL_STATE_CANCELING, GOAL_EVENT_ABORT}, GOAL_STATE_ABORTED},
      {{GOAL_STATE_CANCELING, GOAL_EVENT_CANCELED}, GOAL_STATE_CANCELED},
  };
  for (int state = GOAL_STATE_UNKNOWN; state < GOAL_STATE_NUM_STATES; ++state) {
    for (int event = GOAL_EVENT_EXECUTE; event < GOAL_EVENT_NUM_EVENTS; ++event) {
      const std::pair from(static_cast<rcl_action_goal_state_t>(state), static_cast<rcl_action_goal_event_t>(event));
      const auto found = allowed.find(from);
      EXPECT_EQ(rcl_action_transition_goal_state(from.first, from.second),
                found == allowed.end() ? GOAL_STATE_UNKNOWN : found->second)
          << state << ' ' << event;
    }
  }
}

TEST(GoalHandle, SaysWhatIsNotAllowed) {
  rcl_action_goal_handle_t goal = rcl_action_get_zero_initialized_goal_handle();
  const rcl_action_goal_info_t info = rcl_action_get_zero_initialized_goal_info();
  ASSERT_EQ(rcl_action_goal_handle_init(&goal, &info, rcl_get_default_allocator()), RCL_RET_OK);
  EXPECT_TRUE(rcl_action_goal_handle_is_active(&goal));
  EXPECT_EQ(rcl_action_update_goal_state(&goal, GOAL_EVENT_SUCCEED), RCL_RET_ACTION_GOAL_EVENT_INVALID);
  EXPECT_THAT(rcl_get_error_string().str, testing::StartsWith("a goal that is accepted cannot succeed, at "));
  rcl_reset_error();
  EXPECT_FALSE(rcl_action_goal_handle_is_abortable(&goal));
  EXPECT_EQ(rcl_action_update_goal_state(&goal, GOAL_EVENT_EXECUTE), RCL_RET_OK);
  EXPECT_TRUE(rcl_action_goal_handle_is_cancelable(&goal));
  EXPECT_TRUE(rcl_action_goal_handle_is_abortable(&goal));
  EXPECT_EQ(rcl_action_update_goal_state(&goal, GOAL_EVENT_ABORT), RCL_RET_OK);
  EXPECT_FALSE(rcl_action_goal_handle_is_active(&goal));
  EXPECT_FALSE(rcl_action_goal_handle_is_cancelable(&goal));
  EXPECT_FALSE(rcl_action_goal_handle_is_abortable(&goal));
  rcl_reset_error();
  EXPECT_EQ(rcl_action_goal_handle_fini(&goal), RCL_RET_OK);
}

TEST(ActionNames, AreThoseOfRos2) {
  const std::map<std::string, rcl_ret_t (*)(const char*, rcl_allocator_t, char**)> names = {
      {"/robot/dock/_action/send_goal", rcl_action_get_goal_service_name},
      {"/robot/dock/_action/cancel_goal", rcl_action_get_cancel_service_name},
      {"/robot/dock/_action/get_result", rcl_action_get_result_service_name},
      {"/robot/dock/_action/feedback", rcl_action_get_feedback_topic_name},
      {"/robot/dock/_action/status", rcl_action_get_status_topic_name},
  };
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  for (const auto& [expected, get] : names) {
    char* name = nullptr;
    ASSERT_EQ(get("/robot/dock", allocator, &name), RCL_RET_OK);
    EXPECT_EQ(name, expected);
    allocator.deallocate(name, allocator.state);
    EXPECT_EQ(get("", allocator, &name), RCL_RET_ACTION_NAME_INVALID);
    rcl_reset_error();
  }
}

}  // namespace
