// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of actions: a server and a client in one executor.
#pragma once

#include <gtest/gtest.h>

#include <example_interfaces/action/fibonacci.hpp>
#include <memory>
#include <rclcpp_action/rclcpp_action.hpp>
#include <utility>
#include <vector>

#include "tests/unit/rclcpp/ros_test.hpp"

using example_interfaces::action::Fibonacci;
using rclcpp_action::CancelResponse;
using rclcpp_action::GoalResponse;
using rclcpp_action::GoalStatus;
using Client = rclcpp_action::Client<Fibonacci>;
using Server = rclcpp_action::Server<Fibonacci>;
using ServerGoal = rclcpp_action::ServerGoalHandle<Fibonacci>;

inline std::shared_ptr<Fibonacci::Result> result_of(std::vector<int32_t> sequence) {
  auto result = std::make_shared<Fibonacci::Result>();
  result->sequence = std::move(sequence);
  return result;
}

class ActionTest : public RosTest {
 protected:
  ActionTest() {
    executor_.add_node(server_node_);
    executor_.add_node(client_node_);
  }

  // A server whose answers are the members below. It keeps the goals in `goals_`.
  void start_server(const rcl_action_server_options_t& options = rcl_action_server_get_default_options()) {
    server_ = rclcpp_action::create_server<Fibonacci>(
        server_node_, "fibonacci",
        [this](const rclcpp_action::GoalUUID&, std::shared_ptr<const Fibonacci::Goal> goal) {
          orders_.push_back(goal->order);
          return goal_answer_;
        },
        [this](std::shared_ptr<ServerGoal>) { return cancel_answer_; },
        [this](std::shared_ptr<ServerGoal> goal) { goals_.push_back(std::move(goal)); }, options);
    client_ = rclcpp_action::create_client<Fibonacci>(client_node_, "fibonacci");
    ASSERT_TRUE(client_->wait_for_action_server(kPatience));
  }

  template <typename FutureT>
  auto value_of(const FutureT& future) {
    EXPECT_TRUE(
        spin_until(executor_, [&] { return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
    return future.get();
  }

  Client::GoalHandle::SharedPtr send(int32_t order, const Client::SendGoalOptions& options = {}) {
    Fibonacci::Goal goal;
    goal.order = order;
    return value_of(client_->async_send_goal(goal, options));
  }

  rclcpp::Node::SharedPtr server_node_ = std::make_shared<rclcpp::Node>("server");
  rclcpp::Node::SharedPtr client_node_ = std::make_shared<rclcpp::Node>("client");
  rclcpp::executors::SingleThreadedExecutor executor_;
  GoalResponse goal_answer_ = GoalResponse::ACCEPT_AND_EXECUTE;
  CancelResponse cancel_answer_ = CancelResponse::ACCEPT;
  std::vector<int32_t> orders_;
  std::vector<std::shared_ptr<ServerGoal>> goals_;
  Server::SharedPtr server_;
  Client::SharedPtr client_;
};
