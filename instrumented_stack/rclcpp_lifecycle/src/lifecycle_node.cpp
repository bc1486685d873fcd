// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_lifecycle/lifecycle_node.hpp"

#include <rcl_lifecycle/default_state_machine.h>

#include <algorithm>
#include <lifecycle_msgs/msg/state.hpp>

#include "lifecycle_services.hpp"
#include "state_manager.hpp"

namespace rclcpp_lifecycle {

using StateId = lifecycle_msgs::msg::State;

LifecycleNode::LifecycleNode(const std::string& node_name, const rclcpp::NodeOptions& options,
                             bool enable_communication_interface)
    : LifecycleNode(node_name, "", options, enable_communication_interface) {}

LifecycleNode::LifecycleNode(const std::string& node_name, const std::string& node_namespace,
                             const rclcpp::NodeOptions& options, bool enable_communication_interface)
    : AnyNode(node_name, node_namespace, options),
      states_(std::make_shared<StateManager>(*get_node_base_interface(), get_logger())) {
  states_->init(enable_communication_interface);
  if (enable_communication_interface) {
    services_ = std::make_unique<LifecycleServices>(*this, states_);
  }
  register_on_configure([this](const State& previous_state) { return on_configure(previous_state); });
  register_on_cleanup([this](const State& previous_state) { return on_cleanup(previous_state); });
  register_on_shutdown([this](const State& previous_state) { return on_shutdown(previous_state); });
  register_on_activate([this](const State& previous_state) { return on_activate(previous_state); });
  register_on_deactivate([this](const State& previous_state) { return on_deactivate(previous_state); });
  register_on_error([this](const State& previous_state) { return on_error(previous_state); });
}

LifecycleNode::~LifecycleNode() {
  // An executor may still hold a service of this node, and the service holds the states.
  states_->forget_callbacks();
  if (get_current_state().id() != StateId::PRIMARY_STATE_FINALIZED) {
    RCLCPP_DEBUG(get_logger(), "LifecycleNode is not shut down: Node still in state(%u) in destructor",
                 unsigned{get_current_state().id()});
  }
}

const State& LifecycleNode::get_current_state() const {
  return states_->current_state();
}
std::vector<State> LifecycleNode::get_available_states() const {
  return states_->states();
}
std::vector<Transition> LifecycleNode::get_available_transitions() const {
  return states_->transitions_of_current_state();
}
std::vector<Transition> LifecycleNode::get_transition_graph() const {
  return states_->transitions();
}

const State& LifecycleNode::trigger_transition(uint8_t transition_id) {
  CallbackReturn ignored;
  return trigger_transition(transition_id, ignored);
}
const State& LifecycleNode::trigger_transition(uint8_t transition_id, CallbackReturn& cb_return_code) {
  states_->change_state(transition_id, cb_return_code);
  return get_current_state();
}

const State& LifecycleNode::configure() {
  CallbackReturn ignored;
  return configure(ignored);
}
const State& LifecycleNode::configure(CallbackReturn& cb_return_code) {
  return trigger_label(rcl_lifecycle_configure_label, cb_return_code);
}
const State& LifecycleNode::cleanup() {
  CallbackReturn ignored;
  return cleanup(ignored);
}
const State& LifecycleNode::cleanup(CallbackReturn& cb_return_code) {
  return trigger_label(rcl_lifecycle_cleanup_label, cb_return_code);
}
const State& LifecycleNode::activate() {
  CallbackReturn ignored;
  return activate(ignored);
}
const State& LifecycleNode::activate(CallbackReturn& cb_return_code) {
  return trigger_label(rcl_lifecycle_activate_label, cb_return_code);
}
const State& LifecycleNode::deactivate() {
  CallbackReturn ignored;
  return deactivate(ignored);
}
const State& LifecycleNode::deactivate(CallbackReturn& cb_return_code) {
  return trigger_label(rcl_lifecycle_deactivate_label, cb_return_code);
}
const State& LifecycleNode::shutdown() {
  CallbackReturn ignored;
  return shutdown(ignored);
}
const State& LifecycleNode::shutdown(CallbackReturn& cb_return_code) {
  return trigger_label(rcl_lifecycle_shutdown_label, cb_return_code);
}

const State& LifecycleNode::trigger_label(const char* label, CallbackReturn& cb_return_code) {
  states_->change_state(std::string(label), cb_return_code);
  return get_current_state();
}

bool LifecycleNode::register_on_configure(std::function<CallbackReturn(const State&)> callback) {
  states_->set_callback(StateId::TRANSITION_STATE_CONFIGURING, std::move(callback));
  return true;
}
bool LifecycleNode::register_on_cleanup(std::function<CallbackReturn(const State&)> callback) {
  states_->set_callback(StateId::TRANSITION_STATE_CLEANINGUP, std::move(callback));
  return true;
}
bool LifecycleNode::register_on_shutdown(std::function<CallbackReturn(const State&)> callback) {
  states_->set_callback(StateId::TRANSITION_STATE_SHUTTINGDOWN, std::move(callback));
  return true;
}
bool LifecycleNode::register_on_activate(std::function<CallbackReturn(const State&)> callback) {
  states_->set_callback(StateId::TRANSITION_STATE_ACTIVATING, std::move(callback));
  return true;
}
bool LifecycleNode::register_on_deactivate(std::function<CallbackReturn(const State&)> callback) {
  states_->set_callback(StateId::TRANSITION_STATE_DEACTIVATING, std::move(callback));
  return true;
}
bool LifecycleNode::register_on_error(std::function<CallbackReturn(const State&)> callback) {
  states_->set_callback(StateId::TRANSITION_STATE_ERRORPROCESSING, std::move(callback));
  return true;
}

LifecycleNode::CallbackReturn LifecycleNode::on_activate(const State&) {
  for (const auto& entity : managed_entities()) {
    entity->on_activate();
  }
  return CallbackReturn::SUCCESS;
}

LifecycleNode::CallbackReturn LifecycleNode::on_deactivate(const State&) {
  for (const auto& entity : managed_entities()) {
    entity->on_deactivate();
  }
  return CallbackReturn::SUCCESS;
}

void LifecycleNode::add_managed_entity(std::weak_ptr<ManagedEntityInterface> managed_entity) {
  const std::lock_guard lock(managed_entities_mutex_);
  std::erase_if(managed_entities_, [](const auto& entity) { return entity.expired(); });
  managed_entities_.push_back(std::move(managed_entity));
}

std::vector<std::shared_ptr<ManagedEntityInterface>> LifecycleNode::managed_entities() const {
  const std::lock_guard lock(managed_entities_mutex_);
  std::vector<std::shared_ptr<ManagedEntityInterface>> living;
  for (const auto& weak : managed_entities_) {
    if (auto entity = weak.lock()) {
      living.push_back(std::move(entity));
    }
  }
  return living;
}

}  // namespace rclcpp_lifecycle
