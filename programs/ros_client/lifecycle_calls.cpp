// SPDX-License-Identifier: Apache-2.0
// Calls the services of a managed node, and follows the events of its transitions (lifecycle_msgs).
#include <chrono>
#include <lifecycle_msgs/msg/transition.hpp>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "programs/ros_client/service_call.hpp"

namespace launch {

namespace {

namespace lifecycle_srv = lifecycle_msgs::srv;
using lifecycle_msgs::msg::Transition;
using lifecycle_msgs::msg::TransitionEvent;
using Clock = std::chrono::steady_clock;

// An event that is published before its writer knows our reader is lost. The state is therefore asked for again from
// time to time.
constexpr std::chrono::milliseconds kAskAgain{250};

Transition transition_of(const std::string& label) {
  static const std::map<std::string, std::uint8_t> ids = {{"configure", Transition::TRANSITION_CONFIGURE},
                                                          {"cleanup", Transition::TRANSITION_CLEANUP},
                                                          {"activate", Transition::TRANSITION_ACTIVATE},
                                                          {"deactivate", Transition::TRANSITION_DEACTIVATE},
                                                          // Chosen by its label, because the number depends on the
                                                          // state.
                                                          {"shutdown", Transition::TRANSITION_UNCONFIGURED_SHUTDOWN}};
  const auto found = ids.find(label);
  if (found == ids.end()) {
    throw std::invalid_argument("there is no transition '" + label + "'");
  }
  Transition transition;
  transition.id = found->second;
  transition.label = label;
  return transition;
}

std::string topic_of_events(const std::string& node) {
  return node + "/transition_event";
}

// The transition_event topic of a node.
class TransitionEvents {
 public:
  TransitionEvents(rclcpp::Node& node, const std::string& of)
      : subscription_(node.create_subscription<TransitionEvent>(topic_of_events(of), rclcpp::QoS(10),
                                                                [](const TransitionEvent&) {})) {}

  std::optional<TransitionEvent> next() {
    TransitionEvent event;
    rclcpp::MessageInfo info;
    if (subscription_->take(event, info)) {
      return event;
    }
    return std::nullopt;
  }
  void add_to(Operation::WakeUps& wake_ups) const {
    wake_ups.subscriptions.push_back(subscription_->get_subscription_handle().get());
  }

 private:
  rclcpp::Subscription<TransitionEvent>::SharedPtr subscription_;
};

class StateWait final : public Operation {
 public:
  StateWait(const StateReached& request, rclcpp::Node& node, Answer answer)
      : Operation(std::move(answer)), request_(request), node_(node), events_(node, request.node) {
    ask();
  }

  void look() override {
    while (const auto event = events_.next()) {
      if (check(event->goal_state.label)) {
        return;
      }
    }
    if (question_) {
      if (const auto response = question_->look()) {
        question_.reset();
        asked_ = Clock::now();
        check(response->current_state.label);
      } else if (question_->is_orphaned()) {
        ask();  // the process of the node may come back
      }
    } else if (Clock::now() - asked_ >= kAskAgain) {
      ask();
    }
  }

  void add_to(WakeUps& wake_ups) const override {
    events_.add_to(wake_ups);
    if (question_) {
      question_->add_to(wake_ups);
    }
  }

  std::string waits_for() const override { return describe(request_); }

 private:
  void ask() {
    question_.emplace(node_, request_.node + "/get_state", std::make_shared<lifecycle_srv::GetState::Request>());
  }

  bool check(const std::string& state) {
    if (state != request_.state) {
      if (state != seen_) {
        seen_ = state;
        RosAnswer seen;
        seen.seen = state;
        tell(seen);
      }
      return false;
    }
    RosAnswer answer;
    answer.ok = true;
    answer.state = state;
    end(answer);
    return true;
  }

  const StateReached request_;
  rclcpp::Node& node_;
  TransitionEvents events_;
  std::optional<ServiceCall<lifecycle_srv::GetState>> question_;
  Clock::time_point asked_;
  std::string seen_;
};

class TransitionWatch final : public Operation {
 public:
  TransitionWatch(const WatchTransitions& request, rclcpp::Node& node, Answer answer)
      : Operation(std::move(answer)), request_(request), events_(node, request.node) {}

  void look() override {
    while (const auto event = events_.next()) {
      RosAnswer answer;
      answer.ok = true;
      answer.state = event->goal_state.label;
      answer.previous_state = event->start_state.label;
      tell(answer);
    }
  }
  void add_to(WakeUps& wake_ups) const override { events_.add_to(wake_ups); }
  std::string waits_for() const override { return describe(request_); }

 private:
  const WatchTransitions request_;
  TransitionEvents events_;
};

// Asks a node for a transition whose events must reach the watches that this program has already. The node is first
// asked for its state. Discovery announces our endpoints in the order of their creation, so a node that can answer a
// client knows every reader made before it.
class TransitionCall final : public CallOperation<lifecycle_srv::ChangeState> {
 public:
  TransitionCall(const ChangeState& request, rclcpp::Node& node, Answer answer)
      : CallOperation(
            std::move(answer),
            ServiceCall<lifecycle_srv::ChangeState>(node, request.node + "/change_state", message_for(request)),
            [](const lifecycle_srv::ChangeState::Response& response) {
              RosAnswer result;
              result.ok = response.success;
              return result;
            }) {
    if (node.count_subscribers(topic_of_events(request.node)) != 0) {
      greeting_.emplace(node, request.node + "/get_state", std::make_shared<lifecycle_srv::GetState::Request>());
    }
  }

  void look() override {
    if (greeting_ && greeting_->look()) {
      greeting_.reset();
    }
    if (!greeting_) {
      CallOperation::look();
    } else if (greeting_->is_orphaned()) {
      fail("the '" + greeting_->service() + "' service has gone before it answered");
    }
  }

  void add_to(WakeUps& wake_ups) const override {
    if (greeting_) {
      greeting_->add_to(wake_ups);
    } else {
      CallOperation::add_to(wake_ups);
    }
  }

 private:
  static std::shared_ptr<lifecycle_srv::ChangeState::Request> message_for(const ChangeState& request) {
    auto message = std::make_shared<lifecycle_srv::ChangeState::Request>();
    message->transition = transition_of(request.transition);
    return message;
  }

  std::optional<ServiceCall<lifecycle_srv::GetState>> greeting_;
};

}  // namespace

std::unique_ptr<Operation> call(const ChangeState& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<TransitionCall>(request, node, std::move(answer));
}

std::unique_ptr<Operation> call(const GetState& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<CallOperation<lifecycle_srv::GetState>>(
      std::move(answer),
      ServiceCall<lifecycle_srv::GetState>(node, request.node + "/get_state",
                                           std::make_shared<lifecycle_srv::GetState::Request>()),
      [](const lifecycle_srv::GetState::Response& response) {
        RosAnswer result;
        result.ok = true;
        result.state = response.current_state.label;
        return result;
      });
}

std::unique_ptr<Operation> wait_for(const StateReached& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<StateWait>(request, node, std::move(answer));
}

std::unique_ptr<Operation> watch(const WatchTransitions& request, rclcpp::Node& node, Operation::Answer answer) {
  return std::make_unique<TransitionWatch>(request, node, std::move(answer));
}

}  // namespace launch
