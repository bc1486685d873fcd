// SPDX-License-Identifier: Apache-2.0
// The goals of a server, with messages of C as rclpy has them.
#include <rcl/error_handling.h>
#include <rcl_action/rcl_action.h>

#include <cstring>
#include <memory>

#include "example_interfaces/action/fibonacci.h"
#include "tests/support/sandbox.hpp"
#include "tests/unit/rcl/rcl_test.hpp"

namespace {

using rcl_test::Context;
using rcl_test::Node;
using rcl_test::take_error;

constexpr int64_t kSecond = 1'000'000'000;

class ActionServer : public testing::Test {
 protected:
  ActionServer() {
    rcl_allocator_t allocator = rcl_get_default_allocator();
    EXPECT_EQ(rcl_clock_init(RCL_ROS_TIME, &clock_, &allocator), RCL_RET_OK);
    EXPECT_EQ(rcl_enable_ros_time_override(&clock_), RCL_RET_OK);
    set_time(100 * kSecond);
    rcl_action_server_options_t options = rcl_action_server_get_default_options();
    options.result_timeout.nanoseconds = kSecond;
    EXPECT_EQ(
        rcl_action_server_init(&server_, &node_.handle, &clock_,
                               ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci), "fibonacci", &options),
        RCL_RET_OK)
        << take_error();
  }
  ~ActionServer() override {
    EXPECT_EQ(rcl_action_server_fini(&server_, &node_.handle), RCL_RET_OK);
    EXPECT_EQ(rcl_clock_fini(&clock_), RCL_RET_OK);
  }

  void set_time(int64_t time) { EXPECT_EQ(rcl_set_ros_time_override(&clock_, time), RCL_RET_OK); }

  // A goal that ends with the last copy of its handle.
  std::shared_ptr<rcl_action_goal_handle_t> accept(uint8_t id) {
    rcl_action_goal_info_t info = rcl_action_get_zero_initialized_goal_info();
    info.goal_id.uuid[0] = id;
    const rcl_action_goal_handle_t* accepted = rcl_action_accept_new_goal(&server_, &info);
    if (accepted == nullptr) {
      return nullptr;
    }
    return {new rcl_action_goal_handle_t(*accepted), [](rcl_action_goal_handle_t* handle) {
              EXPECT_EQ(rcl_action_goal_handle_fini(handle), RCL_RET_OK);
              delete handle;
            }};
  }

  test_support::Sandbox sandbox_;
  Context context_;
  Node node_{context_, "node"};
  rcl_clock_t clock_{};
  rcl_action_server_t server_ = rcl_action_get_zero_initialized_server();
};

TEST_F(ActionServer, TellsTheStatesOfItsGoals) {
  const auto first = accept(1);
  const auto second = accept(2);
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(accept(2), nullptr);
  EXPECT_EQ(take_error(), "there is a goal of this id already");
  ASSERT_EQ(rcl_action_update_goal_state(second.get(), GOAL_EVENT_EXECUTE), RCL_RET_OK);

  rcl_action_goal_status_array_t array = rcl_action_get_zero_initialized_goal_status_array();
  ASSERT_EQ(rcl_action_get_goal_status_array(&server_, &array), RCL_RET_OK);
  ASSERT_EQ(array.msg.status_list.size, 2u);
  EXPECT_EQ(array.msg.status_list.data[0].status, GOAL_STATE_ACCEPTED);
  EXPECT_EQ(array.msg.status_list.data[0].goal_info.goal_id.uuid[0], 1);
  EXPECT_EQ(array.msg.status_list.data[0].goal_info.stamp.sec, 100);
  EXPECT_EQ(array.msg.status_list.data[1].status, GOAL_STATE_EXECUTING);
  EXPECT_EQ(rcl_action_publish_status(&server_, &array), RCL_RET_OK) << take_error();
  EXPECT_EQ(rcl_action_get_goal_status_array(&server_, &array), RCL_RET_ALREADY_INIT);
  EXPECT_EQ(take_error(), "the message is initialized already");
  EXPECT_EQ(rcl_action_goal_status_array_fini(&array), RCL_RET_OK);
  EXPECT_EQ(array.msg.status_list.data, nullptr);
}

TEST_F(ActionServer, FindsTheGoalsToCancel) {
  const auto first = accept(1);
  const auto second = accept(2);
  const auto cancelable = [&](const rcl_action_cancel_request_t& request) {
    rcl_action_cancel_response_t response = rcl_action_get_zero_initialized_cancel_response();
    EXPECT_EQ(rcl_action_process_cancel_request(&server_, &request, &response), RCL_RET_OK) << take_error();
    std::string found = std::to_string(response.msg.return_code) + ":";
    for (size_t i = 0; i < response.msg.goals_canceling.size; ++i) {
      found += " " + std::to_string(response.msg.goals_canceling.data[i].goal_id.uuid[0]);
    }
    EXPECT_EQ(rcl_action_cancel_response_fini(&response), RCL_RET_OK);
    return found;
  };
  rcl_action_cancel_request_t request = rcl_action_get_zero_initialized_cancel_request();
  EXPECT_EQ(cancelable(request), "0: 1 2");
  request.goal_info.goal_id.uuid[0] = 2;
  EXPECT_EQ(cancelable(request), "0: 2");
  request.goal_info.goal_id.uuid[0] = 3;
  EXPECT_EQ(cancelable(request), std::to_string(CANCEL_STATE_UNKNOWN_GOAL) + ":");
  ASSERT_EQ(rcl_action_update_goal_state(second.get(), GOAL_EVENT_EXECUTE), RCL_RET_OK);
  ASSERT_EQ(rcl_action_update_goal_state(second.get(), GOAL_EVENT_SUCCEED), RCL_RET_OK);
  request.goal_info.goal_id.uuid[0] = 2;
  EXPECT_EQ(cancelable(request), std::to_string(CANCEL_STATE_TERMINATED) + ":");
}

TEST_F(ActionServer, ForgetsGoalsThatHaveEndedSomeTimeAgo) {
  const auto goal = accept(1);
  rcl_action_goal_info_t expired = rcl_action_get_zero_initialized_goal_info();
  size_t count = 99;
  ASSERT_EQ(rcl_action_update_goal_state(goal.get(), GOAL_EVENT_EXECUTE), RCL_RET_OK);
  ASSERT_EQ(rcl_action_update_goal_state(goal.get(), GOAL_EVENT_SUCCEED), RCL_RET_OK);
  ASSERT_EQ(rcl_action_notify_goal_done(&server_), RCL_RET_OK);
  EXPECT_EQ(rcl_action_expire_goals(&server_, &expired, 1, &count), RCL_RET_OK);
  EXPECT_EQ(count, 0u);
  set_time(102 * kSecond);
  EXPECT_EQ(rcl_action_expire_goals(&server_, &expired, 1, &count), RCL_RET_OK);
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(expired.goal_id.uuid[0], 1);
  EXPECT_FALSE(rcl_action_server_goal_exists(&server_, &expired));
  EXPECT_FALSE(rcl_action_goal_handle_is_active(goal.get()));  // the copy is still there
}

TEST_F(ActionServer, SetsTheTimerOfItsCaller) {
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  ASSERT_EQ(
      rcl_timer_init2(&timer, &clock_, &context_.handle, 100 * kSecond, nullptr, rcl_get_default_allocator(), false),
      RCL_RET_OK);
  rcl_action_server_t server = rcl_action_get_zero_initialized_server();
  rcl_action_server_options_t options = rcl_action_server_get_default_options();
  options.result_timeout.nanoseconds = kSecond;
  const auto* type = ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci);
  EXPECT_EQ(rcl_action_server_init2(&server, &node_.handle, nullptr, type, "other", &options),
            RCL_RET_INVALID_ARGUMENT);
  (void)take_error();
  ASSERT_EQ(rcl_action_server_init2(&server, &node_.handle, &timer, type, "other", &options), RCL_RET_OK)
      << take_error();
  size_t timers = 99;
  size_t others = 0;
  EXPECT_EQ(rcl_action_server_wait_set_get_num_entities(&server, &others, &others, &timers, &others, &others),
            RCL_RET_OK);
  EXPECT_EQ(timers, 0u);
  rcl_action_goal_info_t info = rcl_action_get_zero_initialized_goal_info();
  info.goal_id.uuid[0] = 1;
  rcl_action_goal_handle_t* goal = rcl_action_accept_new_goal(&server, &info);
  ASSERT_NE(goal, nullptr);
  ASSERT_EQ(rcl_action_update_goal_state(goal, GOAL_EVENT_EXECUTE), RCL_RET_OK);
  ASSERT_EQ(rcl_action_update_goal_state(goal, GOAL_EVENT_SUCCEED), RCL_RET_OK);
  ASSERT_EQ(rcl_action_notify_goal_done(&server), RCL_RET_OK);
  int64_t period = 0;
  EXPECT_EQ(rcl_timer_get_period(&timer, &period), RCL_RET_OK);
  EXPECT_EQ(period, kSecond);
  rcl_action_goal_handle_t copy = *goal;
  EXPECT_EQ(rcl_action_goal_handle_fini(&copy), RCL_RET_OK);
  EXPECT_EQ(rcl_action_server_fini(&server, &node_.handle), RCL_RET_OK);
  EXPECT_EQ(rcl_timer_fini(&timer), RCL_RET_OK);
}

TEST_F(ActionServer, HasItsServicesFromAnIndexInAWaitSet) {
  rcl_action_client_t client = rcl_action_get_zero_initialized_client();
  const rcl_action_client_options_t options = rcl_action_client_get_default_options();
  ASSERT_EQ(
      rcl_action_client_init(&client, &node_.handle, ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci),
                             "fibonacci", &options),
      RCL_RET_OK);
  rcl_wait_set_t wait_set = rcl_get_zero_initialized_wait_set();
  ASSERT_EQ(rcl_wait_set_init(&wait_set, 4, 0, 1, 3, 3, 0, &context_.handle, rcl_get_default_allocator()), RCL_RET_OK);
  size_t service = 99;
  size_t first_client = 99;
  size_t subscription = 99;
  EXPECT_EQ(rcl_action_wait_set_add_action_server(&wait_set, &server_, &service), RCL_RET_OK);
  EXPECT_EQ(rcl_action_wait_set_add_action_client(&wait_set, &client, &first_client, &subscription), RCL_RET_OK);
  EXPECT_EQ(service, 0u);
  EXPECT_EQ(first_client, 0u);
  EXPECT_EQ(subscription, 0u);
  EXPECT_EQ(rcl_wait_set_fini(&wait_set), RCL_RET_OK);
  EXPECT_EQ(rcl_action_client_fini(&client, &node_.handle), RCL_RET_OK);
}

}  // namespace
