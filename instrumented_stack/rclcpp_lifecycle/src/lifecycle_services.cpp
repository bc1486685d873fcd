// SPDX-License-Identifier: Apache-2.0
#include "lifecycle_services.hpp"

#include <string>
#include <utility>

#include "rclcpp_lifecycle/lifecycle_node.hpp"

namespace rclcpp_lifecycle {

namespace {

using lifecycle_msgs::msg::TransitionDescription;
using lifecycle_msgs::srv::ChangeState;
using lifecycle_msgs::srv::GetAvailableStates;
using lifecycle_msgs::srv::GetAvailableTransitions;
using lifecycle_msgs::srv::GetState;

lifecycle_msgs::msg::State to_message(const State& state) {
  lifecycle_msgs::msg::State message;
  message.id = state.id();
  message.label = state.label();
  return message;
}

TransitionDescription to_message(const Transition& transition) {
  TransitionDescription message;
  message.transition.id = transition.id();
  message.transition.label = transition.label();
  message.start_state = to_message(transition.start_state());
  message.goal_state = to_message(transition.goal_state());
  return message;
}

void to_messages(const std::vector<Transition>& transitions, GetAvailableTransitions::Response& response) {
  for (const Transition& transition : transitions) {
    response.available_transitions.push_back(to_message(transition));
  }
}

// Creates a service. Its callback gets the states and the request and fills in the response.
template <typename ServiceT, typename AnswerT>
typename rclcpp::Service<ServiceT>::SharedPtr make_service(LifecycleNode& node, std::shared_ptr<StateManager> states,
                                                           const char* name, AnswerT answer) {
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;
  // An executor may keep a service longer than the node lives, so the service holds the states.
  return node.create_service<ServiceT>(
      name,
      [states = std::move(states), answer](const std::shared_ptr<Request> request, std::shared_ptr<Response> response) {
        answer(*states, *request, *response);
      });
}

}  // namespace

LifecycleServices::LifecycleServices(LifecycleNode& node, const std::shared_ptr<StateManager>& states) {
  change_state_ = make_service<ChangeState>(
      node, states, "~/change_state",
      [](StateManager& manager, const ChangeState::Request& request, ChangeState::Response& response) {
        // A label takes precedence. A request with a label may leave the id at 0.
        StateManager::CallbackReturn result = StateManager::CallbackReturn::ERROR;
        if (request.transition.label.empty()) {
          manager.change_state(request.transition.id, result);
        } else {
          manager.change_state(std::string(request.transition.label), result);
        }
        response.success = result == StateManager::CallbackReturn::SUCCESS;
      });
  get_state_ = make_service<GetState>(
      node, states, "~/get_state", [](StateManager& manager, const GetState::Request&, GetState::Response& response) {
        response.current_state = to_message(manager.current_state());
      });
  get_available_states_ = make_service<GetAvailableStates>(
      node, states, "~/get_available_states",
      [](StateManager& manager, const GetAvailableStates::Request&, GetAvailableStates::Response& response) {
        for (const State& state : manager.states()) {
          response.available_states.push_back(to_message(state));
        }
      });
  get_available_transitions_ = make_service<GetAvailableTransitions>(
      node, states, "~/get_available_transitions",
      [](StateManager& manager, const GetAvailableTransitions::Request&, GetAvailableTransitions::Response& response) {
        to_messages(manager.transitions_of_current_state(), response);
      });
  get_transition_graph_ = make_service<GetAvailableTransitions>(
      node, states, "~/get_transition_graph",
      [](StateManager& manager, const GetAvailableTransitions::Request&, GetAvailableTransitions::Response& response) {
        to_messages(manager.transitions(), response);
      });
}

}  // namespace rclcpp_lifecycle
