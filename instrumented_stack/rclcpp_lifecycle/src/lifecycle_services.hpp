// SPDX-License-Identifier: Apache-2.0
// The services of a managed node.
#pragma once

#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_available_states.hpp>
#include <lifecycle_msgs/srv/get_available_transitions.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <memory>

#include "rclcpp/service.hpp"
#include "state_manager.hpp"

namespace rclcpp_lifecycle {

class LifecycleNode;

// They run in the default callback group of the node. The states must have their com interface.
class LifecycleServices {
 public:
  LifecycleServices(LifecycleNode& node, const std::shared_ptr<StateManager>& states);

 private:
  template <typename ServiceT>
  using ServicePtr = typename rclcpp::Service<ServiceT>::SharedPtr;

  ServicePtr<lifecycle_msgs::srv::ChangeState> change_state_;
  ServicePtr<lifecycle_msgs::srv::GetState> get_state_;
  ServicePtr<lifecycle_msgs::srv::GetAvailableStates> get_available_states_;
  ServicePtr<lifecycle_msgs::srv::GetAvailableTransitions> get_available_transitions_;
  ServicePtr<lifecycle_msgs::srv::GetAvailableTransitions> get_transition_graph_;
};

}  // namespace rclcpp_lifecycle
