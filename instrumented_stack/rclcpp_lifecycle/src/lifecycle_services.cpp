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

// The service `handle` of the state machine. Its callback gets the states and the request and fills in the response.
template <typename ServiceT, typename AnswerT>
typename rclcpp::Service<ServiceT>::SharedPtr serve(LifecycleNode& node, const std::shared_ptr<StateManager>& states,
                                                    rcl_service_t& handle, AnswerT answer) {
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;
  // An executor may keep a service longer than the node lives, so the service holds the states.
  rclcpp::AnyServiceCallback<ServiceT> callback(
      [states, answer](const std::shared_ptr<Request> request, std::shared_ptr<Response> response) {
        answer(*states, *request, *response);
      });
  auto service =
      std::make_shared<rclcpp::Service<ServiceT>>(node.get_node_base_interface()->get_shared_rcl_node_handle(),
                                                  std::shared_ptr<rcl_service_t>(states, &handle), std::move(callback));
  node.get_node_services_interface()->add_service(service, nullptr);
  return service;
}

}  // namespace

LifecycleServices::LifecycleServices(LifecycleNode& node, const std::shared_ptr<StateManager>& states) {
  rcl_lifecycle_com_interface_t& com = states->com_interface();
  change_state_ = serve<ChangeState>(
      node, states, com.srv_change_state,
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
  get_state_ = serve<GetState>(node, states, com.srv_get_state,
                               [](StateManager& manager, const GetState::Request&, GetState::Response& response) {
                                 response.current_state = to_message(manager.current_state());
                               });
  get_available_states_ = serve<GetAvailableStates>(
      node, states, com.srv_get_available_states,
      [](StateManager& manager, const GetAvailableStates::Request&, GetAvailableStates::Response& response) {
        for (const State& state : manager.states()) {
          response.available_states.push_back(to_message(state));
        }
      });
  get_available_transitions_ = serve<GetAvailableTransitions>(
      node, states, com.srv_get_available_transitions,
      [](StateManager& manager, const GetAvailableTransitions::Request&, GetAvailableTransitions::Response& response) {
        to_messages(manager.transitions_of_current_state(), response);
      });
  get_transition_graph_ = serve<GetAvailableTransitions>(
      node, states, com.srv_get_transition_graph,
      [](StateManager& manager, const GetAvailableTransitions::Request&, GetAvailableTransitions::Response& response) {
        to_messages(manager.transitions(), response);
      });
}

}  // namespace rclcpp_lifecycle
