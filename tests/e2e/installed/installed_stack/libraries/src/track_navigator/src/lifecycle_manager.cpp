// SPDX-License-Identifier: Apache-2.0
#include "track_navigator/lifecycle_manager.hpp"

#include <lifecycle_msgs/msg/transition.hpp>

namespace track_navigator {

using lifecycle_msgs::msg::Transition;

LifecycleManager::LifecycleManager(const rclcpp::NodeOptions& options) : Node("lifecycle_manager", options) {
  declare_parameter("node_names", rclcpp::PARAMETER_STRING_ARRAY);
  node_names_ = get_parameter("node_names").as_string_array();
  for (const std::string& name : node_names_) {
    using lifecycle_msgs::srv::ChangeState;
    using lifecycle_msgs::srv::GetState;
    change_[name] = std::make_unique<ServiceClient<ChangeState>>(
        name + "/change_state", rclcpp::Node::make_shared(name + "_client", get_node_options()));
    get_[name] = std::make_unique<ServiceClient<GetState>>(
        name + "/get_state", rclcpp::Node::make_shared(name + "_state", get_node_options()));
  }
  is_active_ = create_service<std_srvs::srv::Trigger>(
      std::string(get_name()) + "/is_active",
      [this](const std::shared_ptr<rmw_request_id_t>, const std::shared_ptr<std_srvs::srv::Trigger::Request>,
             std::shared_ptr<std_srvs::srv::Trigger::Response> response) { response->success = is_up_; });
}

bool LifecycleManager::startup() {
  for (const unsigned char transition : {Transition::TRANSITION_CONFIGURE, Transition::TRANSITION_ACTIVATE}) {
    for (const std::string& name : node_names_) {
      if (!change(name, transition)) {
        RCLCPP_ERROR(get_logger(), "Failed to bring up %s. Aborting bringup.", name.c_str());
        return false;
      }
    }
  }
  for (const std::string& name : node_names_) {
    bonds_[name] = std::make_shared<track_bond::Bond>(
        "bond", name, std::static_pointer_cast<rclcpp::Node>(shared_from_this()), [this, name] {
          RCLCPP_ERROR(get_logger(), "%s is gone", name.c_str());
          is_up_ = false;
        });
    bonds_[name]->start(std::chrono::milliseconds(10), std::chrono::minutes(1));
  }
  is_up_ = true;
  return true;
}

bool LifecycleManager::shutdown() {
  bonds_.clear();
  is_up_ = false;
  for (auto name = node_names_.rbegin(); name != node_names_.rend(); ++name) {
    if (!change(*name, Transition::TRANSITION_DEACTIVATE) || !change(*name, Transition::TRANSITION_CLEANUP)) {
      return false;
    }
  }
  return true;
}

unsigned char LifecycleManager::state_of(const std::string& node) {
  const auto request = std::make_shared<lifecycle_msgs::srv::GetState::Request>();
  return get_.at(node)->invoke(request)->current_state.id;
}

bool LifecycleManager::change(const std::string& node, unsigned char transition) {
  const auto request = std::make_shared<lifecycle_msgs::srv::ChangeState::Request>();
  request->transition.id = transition;
  return change_.at(node)->invoke(request)->success;
}

}  // namespace track_navigator
