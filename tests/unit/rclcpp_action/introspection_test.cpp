// SPDX-License-Identifier: Apache-2.0
// The messages that servers and clients of actions publish about the calls of their services.
#include <gmock/gmock.h>

#include <example_interfaces/action/fibonacci.hpp>
#include <memory>
#include <rclcpp_action/rclcpp_action.hpp>
#include <string>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using example_interfaces::action::Fibonacci;
using testing::UnorderedElementsAre;
using Goal = rclcpp_action::ServerGoalHandle<Fibonacci>;
using SendGoal = Fibonacci::Impl::SendGoalService;
using GetResult = Fibonacci::Impl::GetResultService;
using CancelGoal = Fibonacci::Impl::CancelGoalService;

rclcpp::QoS event_qos() {
  return rclcpp::QoS(50).transient_local();
}

class ActionIntrospection : public RosTest {
 protected:
  ActionIntrospection() {
    executor_.add_node(node_);
    server_ = rclcpp_action::create_server<Fibonacci>(
        node_, "fibonacci",
        [](const rclcpp_action::GoalUUID&, std::shared_ptr<const Fibonacci::Goal>) {
          return rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
        },
        [](std::shared_ptr<Goal>) { return rclcpp_action::CancelResponse::REJECT; },
        [this](std::shared_ptr<Goal> goal) { goal_ = std::move(goal); });
    client_ = rclcpp_action::create_client<Fibonacci>(node_, "fibonacci");
    EXPECT_TRUE(client_->wait_for_action_server(kPatience));
  }

  template <typename FutureT>
  auto value_of(const FutureT& future) {
    EXPECT_TRUE(
        spin_until(executor_, [&] { return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
    return future.get();
  }

  // Sends a goal of order 1, asks in vain to cancel it, and waits for the result [8].
  void run_goal() {
    Fibonacci::Goal order;
    order.order = 1;
    const auto handle = value_of(client_->async_send_goal(order));
    ASSERT_TRUE(handle);
    value_of(client_->async_cancel_goal(handle));
    auto future = client_->async_get_result(handle);
    auto result = std::make_shared<Fibonacci::Result>();
    result->sequence = {8};
    goal_->succeed(result);
    value_of(future);
  }

  // Events of one of the services, as "<event type>: <requests>/<responses>".
  template <typename ServiceT>
  struct Watcher {
    Watcher(rclcpp::Node& node, const std::string& service) {
      subscription = node.create_subscription<typename ServiceT::Event>(
          "/fibonacci/_action/" + service + "/_service_event", event_qos(),
          [this](const typename ServiceT::Event& event) {
            events.push_back(event);
            told.push_back(std::to_string(event.info.event_type) + ": " + std::to_string(event.request.size()) + "/" +
                           std::to_string(event.response.size()));
          });
    }
    typename rclcpp::Subscription<typename ServiceT::Event>::SharedPtr subscription;
    std::vector<typename ServiceT::Event> events;
    std::vector<std::string> told;
  };

  rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  rclcpp::executors::SingleThreadedExecutor executor_;
  rclcpp_action::Server<Fibonacci>::SharedPtr server_;
  rclcpp_action::Client<Fibonacci>::SharedPtr client_;
  std::shared_ptr<Goal> goal_;
};

TEST_F(ActionIntrospection, TellsOfTheThreeServices) {
  server_->configure_introspection(node_->get_clock(), event_qos(), RCL_SERVICE_INTROSPECTION_CONTENTS);
  client_->configure_introspection(node_->get_clock(), event_qos(), RCL_SERVICE_INTROSPECTION_METADATA);
  Watcher<SendGoal> goal(*node_, "send_goal");
  Watcher<CancelGoal> cancel(*node_, "cancel_goal");
  Watcher<GetResult> result(*node_, "get_result");
  run_goal();
  EXPECT_TRUE(spin_until(executor_,
                         [&] { return goal.told.size() >= 4 && cancel.told.size() >= 4 && result.told.size() >= 4; }));
  EXPECT_THAT(goal.told, UnorderedElementsAre("0: 0/0", "1: 1/0", "2: 0/1", "3: 0/0"));
  EXPECT_THAT(cancel.told, UnorderedElementsAre("0: 0/0", "1: 1/0", "2: 0/1", "3: 0/0"));
  EXPECT_THAT(result.told, UnorderedElementsAre("0: 0/0", "1: 1/0", "2: 0/1", "3: 0/0"));
  for (const auto& event : goal.events) {
    if (!event.request.empty()) {
      EXPECT_EQ(event.request[0].goal.order, 1);
    }
  }
  for (const auto& event : result.events) {
    if (!event.response.empty()) {
      EXPECT_EQ(event.response[0].result.sequence, std::vector<int32_t>{8});
    }
  }
}

TEST_F(ActionIntrospection, EndsWhenItIsTurnedOff) {
  const auto publishers = [this] {
    std::vector<size_t> counts;
    for (const char* service : {"send_goal", "cancel_goal", "get_result"}) {
      counts.push_back(node_->count_publishers(std::string("/fibonacci/_action/") + service + "/_service_event"));
    }
    return counts;
  };
  using Counts = std::vector<size_t>;
  EXPECT_EQ(publishers(), (Counts{0, 0, 0}));
  server_->configure_introspection(node_->get_clock(), event_qos(), RCL_SERVICE_INTROSPECTION_METADATA);
  EXPECT_EQ(publishers(), (Counts{1, 1, 1}));
  client_->configure_introspection(node_->get_clock(), event_qos(), RCL_SERVICE_INTROSPECTION_CONTENTS);
  EXPECT_EQ(publishers(), (Counts{2, 2, 2}));
  server_->configure_introspection(node_->get_clock(), event_qos(), RCL_SERVICE_INTROSPECTION_OFF);
  client_->configure_introspection(node_->get_clock(), event_qos(), RCL_SERVICE_INTROSPECTION_OFF);
  EXPECT_EQ(publishers(), (Counts{0, 0, 0}));
}

template <typename EndT>
std::string refusal(EndT& end) {
  try {
    end.configure_introspection(nullptr, event_qos(), RCL_SERVICE_INTROSPECTION_METADATA);
  } catch (const rclcpp::exceptions::RCLInvalidArgument& error) {
    // The rest is the place in the source.
    return std::string(error.what()).substr(0, std::string(error.what()).find(", at "));
  }
  return "accepted";
}

TEST_F(ActionIntrospection, NeedsAClock) {
  EXPECT_EQ(refusal(*server_), "failed to configure action server introspection: clock argument is null");
  EXPECT_EQ(refusal(*client_), "failed to configure action client introspection: clock argument is null");
}

TEST(RclActionIntrospection, WhatIsNotInitializedIsRefused) {
  rcl_action_client_t client = rcl_action_get_zero_initialized_client();
  const rcl_publisher_options_t options = rcl_publisher_get_default_options();
  EXPECT_EQ(rcl_action_client_configure_action_introspection(&client, nullptr, nullptr, nullptr, options,
                                                             RCL_SERVICE_INTROSPECTION_OFF),
            RCL_RET_ACTION_CLIENT_INVALID);
  EXPECT_STREQ(rcl_get_error_state()->message, "the action client is not initialized");
  rcl_reset_error();
  rcl_action_server_t server = rcl_action_get_zero_initialized_server();
  EXPECT_EQ(rcl_action_server_configure_action_introspection(&server, nullptr, nullptr, nullptr, options,
                                                             RCL_SERVICE_INTROSPECTION_OFF),
            RCL_RET_ACTION_SERVER_INVALID);
  EXPECT_STREQ(rcl_get_error_state()->message, "the action server is not initialized");
  rcl_reset_error();
}

}  // namespace
