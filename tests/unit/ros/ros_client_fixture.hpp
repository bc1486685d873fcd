// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of launch-ros-client: the real program asks nodes of the test over DDS.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <thread>

#include "base/environment/own_environment.hpp"
#include "launcher/ros/ros_client_process.hpp"
#include "launcher/ros/ros_program.hpp"
#include "tests/support/sandbox.hpp"

class RosClientTest : public testing::Test {
 protected:
  RosClientTest() {
    rclcpp::init(0, nullptr, rclcpp::InitOptions(), rclcpp::SignalHandlerOptions::None);
    node_ = std::make_shared<rclcpp::Node>("peer", "ns");
    executor_ = std::make_unique<rclcpp::executors::SingleThreadedExecutor>();
    executor_->add_node(node_);
  }
  ~RosClientTest() override {
    if (spinner_.joinable()) {
      executor_->cancel();
      spinner_.join();
    }
    executor_.reset();
    node_.reset();
    rclcpp::shutdown();
  }

  // Serves the nodes that were created so far and those that will be.
  void spin() {
    spinner_ = std::thread([this] { executor_->spin(); });
  }

  launch::RosAnswer ask(const launch::RosRequest& request, launch::Duration timeout = launch::Duration::zero()) {
    std::optional<launch::RosAnswer> answer;
    const auto source = client_.ask(request, environment_, timeout, [&](const launch::RosAnswer& given) {
      answer = given;
      loop_->quit();
    });
    EXPECT_FALSE(answer);
    while (!answer) {
      loop_->run();  // another answer may end the loop
    }
    return *answer;
  }

  test_support::Sandbox sandbox_;
  launch::Environment environment_ = launch::own_environment();
  std::unique_ptr<launch::EventLoop> loop_ = launch::make_sd_event_loop();
  launch::RosClientProcess client_{
      *loop_, nullptr, launch::companion_program("launch-ros-client", environment_).value_or(LAUNCH_ROS_CLIENT)};
  rclcpp::Node::SharedPtr node_;
  std::unique_ptr<rclcpp::executors::SingleThreadedExecutor> executor_;
  std::thread spinner_;
};
