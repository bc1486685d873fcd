// SPDX-License-Identifier: Apache-2.0
// Actions in the executors of a server and a client: one that is told of events, one with several threads.
#include <gmock/gmock.h>

#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <thread>

#include "action_fixture.hpp"

namespace {

using rclcpp_action::ResultCode;
using testing::ElementsAre;
using testing::SizeIs;

// Executors that are told of events.
template <typename ExecutorT>
std::unique_ptr<rclcpp::Executor> make_executor() {
  return std::make_unique<ExecutorT>();
}
using MakeExecutor = std::unique_ptr<rclcpp::Executor> (*)();
constexpr MakeExecutor kEvents = make_executor<rclcpp::experimental::executors::EventsExecutor>;
constexpr MakeExecutor kEventsCbg = make_executor<rclcpp::executors::EventsCBGExecutor>;

class ActionInNotifiedExecutorTest : public ActionTest, public testing::WithParamInterface<MakeExecutor> {};
INSTANTIATE_TEST_SUITE_P(Each, ActionInNotifiedExecutorTest, testing::Values(kEvents, kEventsCbg),
                         [](const testing::TestParamInfo<MakeExecutor>& made) {
                           return made.param == kEvents ? "Events" : "EventsCbg";
                         });

TEST_P(ActionInNotifiedExecutorTest, IsServed) {
  executor_.remove_node(server_node_);
  executor_.remove_node(client_node_);
  start_server();
  const auto owned = GetParam()();
  rclcpp::Executor& executor = *owned;
  executor.add_node(server_node_);
  executor.add_node(client_node_);
  std::vector<ResultCode> codes;
  std::vector<std::size_t> feedback;
  Client::SendGoalOptions options;
  options.feedback_callback = [&](Client::GoalHandle::SharedPtr, std::shared_ptr<const Fibonacci::Feedback> message) {
    feedback.push_back(message->sequence.size());
  };
  options.result_callback = [&](const Client::WrappedResult& result) { codes.push_back(result.code); };
  const auto accepted = client_->async_send_goal(Fibonacci::Goal(), options);
  EXPECT_TRUE(spin_until(executor, [&] {
    return !goals_.empty() && accepted.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }));
  goals_[0]->publish_feedback(std::make_shared<Fibonacci::Feedback>());
  EXPECT_TRUE(spin_until(executor, [&] { return !feedback.empty(); }));
  client_->async_cancel_goal(accepted.get());
  EXPECT_TRUE(spin_until(executor, [&] { return goals_[0]->is_canceling(); }));
  goals_[0]->canceled(result_of({}));
  EXPECT_TRUE(spin_until(executor, [&] { return !codes.empty(); }));
  EXPECT_THAT(codes, ElementsAre(ResultCode::CANCELED));
}

TEST_P(ActionInNotifiedExecutorTest, ResultExpires) {
  executor_.remove_node(server_node_);
  executor_.remove_node(client_node_);
  rcl_action_server_options_t options = rcl_action_server_get_default_options();
  options.result_timeout.nanoseconds = 50'000'000;
  start_server(options);
  const auto owned = GetParam()();
  rclcpp::Executor& executor = *owned;
  executor.add_node(server_node_);
  executor.add_node(client_node_);
  const auto accepted = client_->async_send_goal(Fibonacci::Goal());
  ASSERT_TRUE(spin_until(executor, [&] {
    return !goals_.empty() && accepted.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }));
  const auto timers = std::static_pointer_cast<rclcpp::Waitable>(server_)->get_timers();
  ASSERT_THAT(timers, SizeIs(1));
  EXPECT_TRUE(timers[0]->is_canceled());
  goals_[0]->succeed(result_of({}));
  EXPECT_FALSE(timers[0]->is_canceled());
  // Nobody asks for the result: the timer alone removes what is kept, and then stops.
  EXPECT_TRUE(spin_until(executor, [&] { return timers[0]->is_canceled(); }));
  const auto result = client_->async_get_result(accepted.get());
  ASSERT_TRUE(
      spin_until(executor, [&] { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
  EXPECT_EQ(result.get().code, ResultCode::UNKNOWN);
}

class ActionInThreadsTest : public ActionTest {
 protected:
  template <typename ExecutorT>
  void expect_that_threads_may_share_server_and_client();
};

// Goals end in threads of their own while others are sent, canceled and answered by several threads of the executor.
template <typename ExecutorT>
void ActionInThreadsTest::expect_that_threads_may_share_server_and_client() {
  constexpr int32_t kGoals = 9;  // services keep ten requests that were not taken
  executor_.remove_node(server_node_);
  executor_.remove_node(client_node_);
  std::vector<std::thread> workers;
  const auto work = [](const std::shared_ptr<ServerGoal>& goal) {
    for (int i = 0; i < 3; ++i) {
      goal->publish_feedback(std::make_shared<Fibonacci::Feedback>());
    }
    // The client of every third goal cancels it.
    if (goal->get_goal()->order % 3 != 0) {
      return goal->succeed(result_of({goal->get_goal()->order}));
    }
    while (!goal->is_canceling()) {
      std::this_thread::yield();
    }
    goal->canceled(result_of({}));
  };
  const auto server_group = server_node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  const auto client_group = client_node_->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  const auto server = rclcpp_action::create_server<Fibonacci>(
      server_node_, "fibonacci",
      [](const rclcpp_action::GoalUUID&, std::shared_ptr<const Fibonacci::Goal>) {
        return GoalResponse::ACCEPT_AND_EXECUTE;
      },
      [](std::shared_ptr<ServerGoal>) { return CancelResponse::ACCEPT; },
      [&](std::shared_ptr<ServerGoal> goal) { workers.emplace_back(work, std::move(goal)); },
      rcl_action_server_get_default_options(), server_group);
  const auto client = rclcpp_action::create_client<Fibonacci>(client_node_, "fibonacci", client_group);
  ASSERT_TRUE(client->wait_for_action_server(kPatience));

  ExecutorT executor(rclcpp::ExecutorOptions(), 4);
  executor.add_node(server_node_);
  executor.add_node(client_node_);
  std::thread spinner([&] { executor.spin(); });
  std::atomic<int> feedback = 0;
  Client::SendGoalOptions options;
  options.feedback_callback = [&](Client::GoalHandle::SharedPtr, std::shared_ptr<const Fibonacci::Feedback>) {
    ++feedback;
  };
  std::vector<std::shared_future<Client::WrappedResult>> results;
  for (int32_t order = 0; order < kGoals; ++order) {
    Fibonacci::Goal goal;
    goal.order = order;
    const auto accepted = client->async_send_goal(goal, options);
    ASSERT_EQ(accepted.wait_for(kPatience), std::future_status::ready);
    results.push_back(client->async_get_result(accepted.get()));
    if (order % 3 == 0) {
      client->async_cancel_goal(accepted.get());
    }
  }
  for (int32_t order = 0; order < kGoals; ++order) {
    ASSERT_EQ(results[order].wait_for(kPatience), std::future_status::ready) << order;
    EXPECT_EQ(results[order].get().code, order % 3 == 0 ? ResultCode::CANCELED : ResultCode::SUCCEEDED) << order;
  }
  executor.cancel();
  spinner.join();
  for (std::thread& worker : workers) {
    worker.join();
  }
}

TEST_F(ActionInThreadsTest, MayShareServerAndClientInTheMultiThreadedExecutor) {
  expect_that_threads_may_share_server_and_client<rclcpp::executors::MultiThreadedExecutor>();
}

TEST_F(ActionInThreadsTest, MayShareServerAndClientInTheEventsCbgExecutor) {
  expect_that_threads_may_share_server_and_client<rclcpp::executors::EventsCBGExecutor>();
}

}  // namespace
