// SPDX-License-Identifier: Apache-2.0
// Clients of actions whose type is known by name only.
#include <gmock/gmock.h>

#include <cstddef>
#include <test_msgs/action/nested_message.hpp>
#include <tf2_msgs/action/lookup_transform.hpp>

#include "message_layout.hpp"
#include "tests/unit/rclcpp_action/action_fixture.hpp"

namespace {

using rclcpp_action::ActionPart;
using rclcpp_action::GenericClient;
using rclcpp_action::GenericClientGoalHandle;
using testing::ElementsAre;

constexpr const char* kType = "example_interfaces/action/Fibonacci";

class GenericActionClient : public ActionTest {
 protected:
  void SetUp() override {
    start_server();
    generic_ = rclcpp_action::create_generic_client(client_node_, "fibonacci", kType);
    ASSERT_TRUE(generic_->wait_for_action_server(kPatience));
  }

  GenericClientGoalHandle::SharedPtr send(int32_t order, const GenericClient::SendGoalOptions& options = {}) {
    Fibonacci::Goal goal;
    goal.order = order;
    return value_of(generic_->async_send_goal(&goal, sizeof goal, options));
  }

  GenericClient::SharedPtr generic_;
};

TEST_F(GenericActionClient, GetsTheResult) {
  const GenericClientGoalHandle::SharedPtr goal = send(7);
  ASSERT_NE(goal, nullptr);
  EXPECT_THAT(orders_, ElementsAre(7));
  EXPECT_EQ(goal->get_status(), GoalStatus::STATUS_ACCEPTED);
  EXPECT_FALSE(goal->is_result_aware());
  const auto future = generic_->async_get_result(goal);
  EXPECT_TRUE(goal->is_result_aware());
  goals_.at(0)->succeed(result_of({0, 1, 1}));
  const GenericClientGoalHandle::WrappedResult result = value_of(future);
  EXPECT_EQ(result.code, GenericClientGoalHandle::ResultCode::SUCCEEDED);
  EXPECT_EQ(result.goal_id, goal->get_goal_id());
  EXPECT_THAT(static_cast<const Fibonacci::Result*>(result.result)->sequence, ElementsAre(0, 1, 1));
}

TEST_F(GenericActionClient, GetsNullForARejectedGoal) {
  goal_answer_ = GoalResponse::REJECT;
  EXPECT_EQ(send(3), nullptr);
}

TEST_F(GenericActionClient, SendsARequestWithItsOwnIdentity) {
  Fibonacci::Impl::SendGoalService::Request request;
  request.goal_id.uuid[3] = 9;
  request.goal.order = 5;
  const GenericClientGoalHandle::SharedPtr goal = value_of(generic_->async_send_goal(&request));
  ASSERT_NE(goal, nullptr);
  EXPECT_EQ(goal->get_goal_id(), request.goal_id.uuid);
  EXPECT_THAT(orders_, ElementsAre(5));
}

TEST_F(GenericActionClient, HearsOfFeedbackAndResult) {
  std::vector<std::vector<int32_t>> heard;
  std::vector<int32_t> ended;
  GenericClient::SendGoalOptions options;
  options.feedback_callback = [&heard](GenericClientGoalHandle::SharedPtr, const void* feedback) {
    heard.push_back(static_cast<const Fibonacci::Feedback*>(feedback)->sequence);
  };
  options.result_callback = [&ended](const GenericClientGoalHandle::WrappedResult& result) {
    ended = static_cast<const Fibonacci::Result*>(result.result)->sequence;
  };
  const GenericClientGoalHandle::SharedPtr goal = send(2, options);
  ASSERT_NE(goal, nullptr);
  auto feedback = std::make_shared<Fibonacci::Feedback>();
  feedback->sequence = {0, 1};
  goals_.at(0)->publish_feedback(feedback);
  EXPECT_TRUE(spin_until(executor_, [&] { return !heard.empty(); }));
  goals_.at(0)->succeed(result_of({0, 1, 1}));
  EXPECT_TRUE(spin_until(executor_, [&] { return !ended.empty(); }));
  EXPECT_THAT(heard, ElementsAre(ElementsAre(0, 1)));
  EXPECT_THAT(ended, ElementsAre(0, 1, 1));
}

TEST_F(GenericActionClient, CancelsGoals) {
  const GenericClientGoalHandle::SharedPtr goal = send(7);
  ASSERT_NE(goal, nullptr);
  const auto response = value_of(generic_->async_cancel_goal(goal));
  ASSERT_EQ(response->goals_canceling.size(), 1u);
  EXPECT_EQ(response->goals_canceling[0].goal_id.uuid, goal->get_goal_id());
}

TEST_F(GenericActionClient, GoalsOfAnotherClientAreUnknown) {
  const GenericClientGoalHandle::SharedPtr goal = send(7);
  const auto other = rclcpp_action::create_generic_client(client_node_, "fibonacci", kType);
  EXPECT_THROW((void)other->async_get_result(goal), rclcpp_action::exceptions::UnknownGoalHandleError);
  const auto future = generic_->async_get_result(goal);
  generic_.reset();
  EXPECT_THROW(value_of(future), rclcpp_action::exceptions::UnawareGoalHandleError);
}

TEST_F(ActionTest, AGenericClientNeedsAKnownType) {
  EXPECT_THROW((void)rclcpp_action::create_generic_client(client_node_, "a", "example_interfaces/action/Nope"),
               std::runtime_error);
  EXPECT_THROW((void)rclcpp_action::create_generic_client(client_node_, "a b", kType), rclcpp::exceptions::RCLError);
}

// The offsets of the parts in the messages that the compiler knows.
template <typename ActionT>
void expect_layout() {
  using Impl = typename ActionT::Impl;
  const rosidl_action_type_support_t& type = *rosidl_typesupport_cpp::get_action_type_support_handle<ActionT>();
  typename Impl::SendGoalService::Request goal;
  typename Impl::GetResultService::Response result;
  typename Impl::FeedbackMessage feedback;
  const auto distance = [](const void* part, const void* whole) {
    return static_cast<std::size_t>(static_cast<const char*>(part) - static_cast<const char*>(whole));
  };
  EXPECT_EQ(offset_of(ActionPart::kGoal, type), distance(&goal.goal, &goal));
  EXPECT_EQ(offset_of(ActionPart::kResult, type), distance(&result.result, &result));
  EXPECT_EQ(offset_of(ActionPart::kFeedback, type), distance(&feedback.feedback, &feedback));
  EXPECT_EQ(distance(&goal.goal_id, &goal), 0u);
  EXPECT_EQ(distance(&result.status, &result), 0u);
}

TEST(MessageLayout, IsThatOfTheCompiler) {
  expect_layout<Fibonacci>();
  expect_layout<tf2_msgs::action::LookupTransform>();
  expect_layout<test_msgs::action::NestedMessage>();
  EXPECT_THROW((void)offset_of(ActionPart::kGoal, rosidl_action_type_support_t{}), std::runtime_error);
}

}  // namespace
