// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <rcl_action/graph.h>

#include <string>

#include "action_fixture.hpp"

namespace {

using rclcpp_action::ResultCode;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using CancelAnswer = action_msgs::srv::CancelGoal::Response;

TEST_F(ActionTest, CarriesGoalFeedbackAndResult) {
  start_server();
  std::vector<std::vector<int32_t>> feedback;
  std::vector<ResultCode> codes;
  Client::SendGoalOptions options;
  options.feedback_callback = [&](Client::GoalHandle::SharedPtr, std::shared_ptr<const Fibonacci::Feedback> message) {
    feedback.push_back(message->sequence);
  };
  options.result_callback = [&](const Client::WrappedResult& result) { codes.push_back(result.code); };
  const auto goal = send(5, options);
  ASSERT_TRUE(goal);
  EXPECT_THAT(orders_, ElementsAre(5));
  ASSERT_THAT(goals_, SizeIs(1));
  EXPECT_EQ(goals_[0]->get_goal_id(), goal->get_goal_id());
  EXPECT_EQ(goals_[0]->get_goal()->order, 5);
  EXPECT_TRUE(goals_[0]->is_executing());
  EXPECT_GT(goal->get_goal_stamp().nanoseconds(), 0);
  EXPECT_TRUE(spin_until(executor_, [&] { return goal->get_status() == GoalStatus::STATUS_EXECUTING; }));

  auto message = std::make_shared<Fibonacci::Feedback>();
  message->sequence = {0, 1};
  goals_[0]->publish_feedback(message);
  EXPECT_TRUE(spin_until(executor_, [&] { return !feedback.empty(); }));
  EXPECT_THAT(feedback, ElementsAre(ElementsAre(0, 1)));

  const auto future = client_->async_get_result(goal);
  goals_[0]->succeed(result_of({0, 1, 1}));
  EXPECT_FALSE(goals_[0]->is_active());
  const Client::WrappedResult result = value_of(future);
  EXPECT_EQ(result.code, ResultCode::SUCCEEDED);
  EXPECT_EQ(result.goal_id, goal->get_goal_id());
  EXPECT_THAT(result.result->sequence, ElementsAre(0, 1, 1));
  EXPECT_THAT(codes, ElementsAre(ResultCode::SUCCEEDED));
  EXPECT_EQ(goal->get_status(), GoalStatus::STATUS_SUCCEEDED);
  EXPECT_THROW(client_->async_get_result(goal), rclcpp_action::exceptions::UnknownGoalHandleError);
}

TEST_F(ActionTest, ResultMayBeAskedForAfterTheEnd) {
  start_server();
  const auto goal = send(1);
  goals_[0]->abort(result_of({0}));
  const Client::WrappedResult result = value_of(client_->async_get_result(goal));
  EXPECT_EQ(result.code, ResultCode::ABORTED);
  EXPECT_THAT(result.result->sequence, ElementsAre(0));
}

TEST_F(ActionTest, RejectedGoalIsNull) {
  start_server();
  goal_answer_ = GoalResponse::REJECT;
  int answers = 0;
  Client::SendGoalOptions options;
  options.goal_response_callback = [&](Client::GoalHandle::SharedPtr goal) {
    EXPECT_EQ(goal, nullptr);
    ++answers;
  };
  EXPECT_EQ(send(-1, options), nullptr);
  EXPECT_EQ(answers, 1);
  EXPECT_THAT(goals_, IsEmpty());
}

TEST_F(ActionTest, GoalIsCanceledWhenTheServerAgrees) {
  start_server();
  const auto goal = send(5);
  const auto result = client_->async_get_result(goal);
  const auto answer = value_of(client_->async_cancel_goal(goal));
  EXPECT_EQ(answer->return_code, CancelAnswer::ERROR_NONE);
  ASSERT_THAT(answer->goals_canceling, SizeIs(1));
  EXPECT_EQ(answer->goals_canceling[0].goal_id.uuid, goal->get_goal_id());
  EXPECT_TRUE(goals_[0]->is_canceling());
  goals_[0]->canceled(result_of({0, 1}));
  EXPECT_EQ(value_of(result).code, ResultCode::CANCELED);
}

TEST_F(ActionTest, CancelingTellsWhyNot) {
  start_server();
  cancel_answer_ = CancelResponse::REJECT;
  const auto goal = send(5);
  EXPECT_EQ(value_of(client_->async_cancel_goal(goal))->return_code, CancelAnswer::ERROR_REJECTED);
  EXPECT_TRUE(goals_[0]->is_executing());
  goals_[0]->succeed(result_of({}));
  EXPECT_EQ(value_of(client_->async_cancel_goal(goal))->return_code, CancelAnswer::ERROR_GOAL_TERMINATED);
}

TEST_F(ActionTest, CancelsAllGoalsOrThoseUntilATime) {
  start_server();
  const auto first = send(1);
  const auto second = send(2);
  ASSERT_LT(first->get_goal_stamp(), second->get_goal_stamp());
  const auto before = value_of(client_->async_cancel_goals_before(first->get_goal_stamp()));
  ASSERT_THAT(before->goals_canceling, SizeIs(1));
  EXPECT_EQ(before->goals_canceling[0].goal_id.uuid, first->get_goal_id());
  // The first goal is on its way already.
  const auto all = value_of(client_->async_cancel_all_goals());
  ASSERT_THAT(all->goals_canceling, SizeIs(1));
  EXPECT_EQ(all->goals_canceling[0].goal_id.uuid, second->get_goal_id());
}

TEST_F(ActionTest, DeferredGoalWaitsForItsExecution) {
  start_server();
  goal_answer_ = GoalResponse::ACCEPT_AND_DEFER;
  const auto goal = send(3);
  EXPECT_FALSE(goals_[0]->is_executing());
  EXPECT_TRUE(goals_[0]->is_active());
  try {
    goals_[0]->succeed(result_of({}));
    FAIL() << "succeeded without having begun";
  } catch (const rclcpp::exceptions::RCLError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("the goal could not succeed: a goal that is accepted cannot succeed"));
  }
  goals_[0]->execute();
  EXPECT_TRUE(spin_until(executor_, [&] { return goal->get_status() == GoalStatus::STATUS_EXECUTING; }));
}

TEST_F(ActionTest, GoalThatIsGivenUpIsCanceled) {
  start_server();
  const auto result = client_->async_get_result(send(3));
  goals_.clear();
  EXPECT_EQ(value_of(result).code, ResultCode::CANCELED);
}

TEST_F(ActionTest, ResultExpires) {
  rcl_action_server_options_t options = rcl_action_server_get_default_options();
  options.result_timeout.nanoseconds = 1'000'000;
  start_server(options);
  const auto goal = send(3);
  goals_[0]->succeed(result_of({}));
  EXPECT_TRUE(spin_until(executor_, [&] {
    return value_of(client_->async_cancel_goal(goal))->return_code == CancelAnswer::ERROR_UNKNOWN_GOAL_ID;
  }));
  const Client::WrappedResult result = value_of(client_->async_get_result(goal));
  EXPECT_EQ(result.code, ResultCode::UNKNOWN);
}

TEST_F(ActionTest, ResultOfAClientThatIsGoneIsAnException) {
  start_server();
  const auto result = client_->async_get_result(send(3));
  client_.reset();
  EXPECT_THROW(value_of(result), rclcpp_action::exceptions::UnawareGoalHandleError);
}

TEST_F(ActionTest, GoalOutlivesItsServer) {
  start_server();
  (void)send(3);
  server_.reset();
  goals_[0]->succeed(result_of({}));
  EXPECT_FALSE(goals_[0]->is_active());
}

TEST_F(ActionTest, GoalMayBeGivenUpAfterTheShutdown) {
  start_server();
  (void)send(3);
  rclcpp::shutdown();
  goals_.clear();
}

TEST_F(ActionTest, StoppedCallbacksAreNotCalled) {
  start_server();
  int calls = 0;
  Client::SendGoalOptions options;
  options.result_callback = [&](const Client::WrappedResult&) { ++calls; };
  const auto goal = send(3, options);
  client_->stop_callbacks(goal);
  goals_[0]->succeed(result_of({}));
  const auto next = send(4);
  goals_[1]->succeed(result_of({}));
  EXPECT_EQ(value_of(client_->async_get_result(next)).code, ResultCode::SUCCEEDED);
  EXPECT_EQ(calls, 0);
}

TEST_F(ActionTest, IsFoundInTheGraph) {
  start_server();
  const auto names_and_types = [&](auto get, auto... of_node) {
    rcl_allocator_t allocator = rcl_get_default_allocator();
    rcl_names_and_types_t found = rcl_get_zero_initialized_names_and_types();
    EXPECT_EQ(get(client_node_->get_node_base_interface()->get_rcl_node_handle(), &allocator, of_node..., &found),
              RCL_RET_OK);
    std::vector<std::string> lines;
    for (size_t i = 0; i < found.names.size; ++i) {
      lines.push_back(std::string(found.names.data[i]) + ": " + found.types[i].data[0]);
    }
    EXPECT_EQ(rcl_names_and_types_fini(&found), RCL_RET_OK);
    return lines;
  };
  const std::string action = "/fibonacci: example_interfaces/action/Fibonacci";
  EXPECT_THAT(names_and_types(rcl_action_get_names_and_types), ElementsAre(action));
  EXPECT_THAT(names_and_types(rcl_action_get_server_names_and_types_by_node, "server", "/"), ElementsAre(action));
  EXPECT_THAT(names_and_types(rcl_action_get_server_names_and_types_by_node, "client", "/"), IsEmpty());
  EXPECT_THAT(names_and_types(rcl_action_get_client_names_and_types_by_node, "client", "/"), ElementsAre(action));

  const auto count = [&](auto get, const char* name) {
    size_t found = 17;
    EXPECT_EQ(get(client_node_->get_node_base_interface()->get_rcl_node_handle(), name, &found), RCL_RET_OK);
    return found;
  };
  EXPECT_EQ(count(rcl_action_count_clients, "/fibonacci"), 1u);
  EXPECT_EQ(count(rcl_action_count_servers, "/fibonacci"), 1u);
  EXPECT_EQ(count(rcl_action_count_servers, "/nobody"), 0u);
}

TEST_F(ActionTest, WrongNameIsAnException) {
  try {
    rclcpp_action::create_client<Fibonacci>(client_node_, "not a name");
    FAIL() << "created";
  } catch (const rclcpp::exceptions::RCLError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("could not create a client of action 'not a name': "));
  }
}

TEST_F(ActionTest, WaitingForAServerEndsInTime) {
  const auto client = rclcpp_action::create_client<Fibonacci>(client_node_, "nobody");
  EXPECT_FALSE(client->action_server_is_ready());
  EXPECT_FALSE(client->wait_for_action_server(std::chrono::milliseconds(1)));
}

}  // namespace
