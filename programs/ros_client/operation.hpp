// SPDX-License-Identifier: Apache-2.0
// One request on which launch-ros-client works.
#pragma once

#include <rcl/client.h>
#include <rcl/subscription.h>

#include <chrono>
#include <functional>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <utility>
#include <vector>

#include "launcher/ros/ros_client.hpp"

namespace launch {

// All functions are called on the thread of the RequestLoop.
class Operation {
 public:
  using Answer = std::function<void(const RosAnswer&)>;

  // The things that wake the loop, besides changes of the graph.
  struct WakeUps {
    std::vector<const rcl_subscription_t*> subscriptions;
    std::vector<const rcl_client_t*> clients;
    std::chrono::nanoseconds patience{0};  // longest time without any of them
  };

  explicit Operation(Answer answer) : answer_(std::move(answer)) {}
  virtual ~Operation() = default;
  Operation(const Operation&) = delete;
  Operation& operator=(const Operation&) = delete;

  // Goes on as far as it can without waiting. Called at the beginning, after each wake-up, and from time to time.
  // Throws rclcpp's exceptions.
  virtual void look() = 0;
  virtual void add_to(WakeUps&) const {}
  // "the '/c/_container/load_node' service", for the message of a time-out.
  virtual std::string waits_for() const = 0;

  bool has_ended() const { return has_ended_; }

 protected:
  // Sends one answer of several.
  void tell(const RosAnswer& answer) { answer_(answer); }
  // Sends the last or only answer.
  void end(const RosAnswer& answer) {
    has_ended_ = true;
    answer_(answer);
  }
  void fail(std::string error) {
    RosAnswer answer;
    answer.error = std::move(error);
    end(answer);
  }

 private:
  Answer answer_;
  bool has_ended_ = false;
};

// The node is the one of this program and must outlive the operation. Throws rclcpp's exceptions for invalid names.
std::unique_ptr<Operation> make_operation(const RosRequest& request, rclcpp::Node& node, Operation::Answer answer);

// The families of operations from which make_operation() chooses.
std::unique_ptr<Operation> call(const LoadNode& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> call(const UnloadNode& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> call(const ListNodes& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> call(const ChangeState& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> call(const GetState& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> call(const SetParameters& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> wait_for(const NodePresent& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> wait_for(const TopicPresent& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> wait_for(const ServicePresent& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> wait_for(const MessagePublished& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> wait_for(const StateReached& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> wait_for(const ParameterReached& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> watch(const WatchMessages& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> watch(const WatchTransitions& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> watch(const MeterTopic& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> watch(const AskService& request, rclcpp::Node& node, Operation::Answer answer);
std::unique_ptr<Operation> watch(const AskState& request, rclcpp::Node& node, Operation::Answer answer);

}  // namespace launch
