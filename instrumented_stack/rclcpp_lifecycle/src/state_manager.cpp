// SPDX-License-Identifier: Apache-2.0
#include "state_manager.hpp"

#include <lifecycle_msgs/msg/state.hpp>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_available_states.hpp>
#include <lifecycle_msgs/srv/get_available_transitions.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <rosidl_typesupport_cpp/service_type_support.hpp>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp_lifecycle {

namespace {

// One object per state, so that a reference to the current state stays valid when the state changes.
const State& constant_state(const rcl_lifecycle_state_t* state) {
  static const std::map<unsigned int, State> states = [] {
    std::map<unsigned int, State> all;
    const rcl_lifecycle_transition_map_t map = rcl_lifecycle_get_default_transition_map();
    for (unsigned int i = 0; i < map.states_size; ++i) {
      all.emplace(map.states[i].id, State(&map.states[i]));
    }
    return all;
  }();
  return states.at(state->id);
}

std::vector<Transition> copy(const rcl_lifecycle_transition_t* transitions, unsigned int size) {
  std::vector<Transition> result;
  for (unsigned int i = 0; i < size; ++i) {
    result.emplace_back(&transitions[i]);
  }
  return result;
}

template <typename ServiceT>
const rosidl_service_type_support_t* type_of() {
  return rosidl_typesupport_cpp::get_service_type_support_handle<ServiceT>();
}

bool is_primary(const rcl_lifecycle_state_t* state) {
  return state->id <= lifecycle_msgs::msg::State::PRIMARY_STATE_FINALIZED;
}

const char* end_label(StateManager::CallbackReturn result) {
  switch (result) {
    case StateManager::CallbackReturn::SUCCESS:
      return rcl_lifecycle_transition_success_label;
    case StateManager::CallbackReturn::FAILURE:
      return rcl_lifecycle_transition_failure_label;
    case StateManager::CallbackReturn::ERROR:
      break;
  }
  return rcl_lifecycle_transition_error_label;
}

}  // namespace

StateManager::StateManager(rclcpp::node_interfaces::NodeBaseInterface& node_base, rclcpp::Logger logger)
    : node_handle_(node_base.get_shared_rcl_node_handle()), logger_(std::move(logger)) {}

void StateManager::init(bool enable_communication_interface) {
  const std::lock_guard lock(mutex_);
  rcl_lifecycle_state_machine_options_t options = rcl_lifecycle_get_default_state_machine_options();
  options.enable_com_interface = enable_communication_interface;
  const rcl_ret_t ret = rcl_lifecycle_state_machine_init(
      &state_machine_, node_handle_.get(),
      rosidl_typesupport_cpp::get_message_type_support_handle<lifecycle_msgs::msg::TransitionEvent>(),
      type_of<lifecycle_msgs::srv::ChangeState>(), type_of<lifecycle_msgs::srv::GetState>(),
      type_of<lifecycle_msgs::srv::GetAvailableStates>(), type_of<lifecycle_msgs::srv::GetAvailableTransitions>(),
      type_of<lifecycle_msgs::srv::GetAvailableTransitions>(), &options);
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(
        ret, "Couldn't initialize state machine for node " + std::string(rcl_node_get_name(node_handle_.get())));
  }
  update_current_state();
}

StateManager::~StateManager() {
  if (rcl_lifecycle_state_machine_fini(&state_machine_, node_handle_.get()) != RCL_RET_OK) {
    RCLCPP_FATAL(logger_, "failed to destroy rcl_state_machine: %s", rcl_get_error_string().str);
    rcl_reset_error();
  }
}

void StateManager::set_callback(uint8_t transition_state, Callback callback) {
  const std::lock_guard lock(mutex_);
  callbacks_[transition_state] = std::move(callback);
}

void StateManager::forget_callbacks() {
  const std::lock_guard lock(mutex_);
  callbacks_.clear();
}

std::vector<State> StateManager::states() const {
  std::vector<State> result;
  const rcl_lifecycle_transition_map_t& map = state_machine_.transition_map;
  for (unsigned int i = 0; i < map.states_size; ++i) {
    result.emplace_back(&map.states[i]);
  }
  return result;
}

std::vector<Transition> StateManager::transitions() const {
  return copy(state_machine_.transition_map.transitions, state_machine_.transition_map.transitions_size);
}

std::vector<Transition> StateManager::transitions_of_current_state() const {
  const std::lock_guard lock(mutex_);
  const rcl_lifecycle_state_t* state = state_machine_.current_state;
  return copy(state->valid_transitions, state->valid_transition_size);
}

bool StateManager::change_state(const std::string& transition_label, CallbackReturn& result) {
  result = CallbackReturn::ERROR;
  uint8_t transition_id = 0;
  {
    const std::lock_guard lock(mutex_);
    const rcl_lifecycle_transition_t* transition =
        rcl_lifecycle_get_transition_by_label(state_machine_.current_state, transition_label.c_str());
    if (transition == nullptr) {
      return false;
    }
    transition_id = static_cast<uint8_t>(transition->id);
  }
  return change_state(transition_id, result);
}

bool StateManager::change_state(uint8_t transition_id, CallbackReturn& result) {
  result = CallbackReturn::ERROR;
  const State* previous_state = nullptr;
  {
    const std::lock_guard lock(mutex_);
    previous_state = &current_state();
    const rcl_lifecycle_state_t* state = state_machine_.current_state;
    // Only the thread that runs the callback of a transition state may trigger the transitions that end it.
    if (!is_primary(state) || rcl_lifecycle_get_transition_by_id(state, transition_id) == nullptr) {
      RCLCPP_ERROR(logger_, "Unable to start transition %u from current state %s: Transition is not registered.",
                   unsigned{transition_id}, state->label);
      return false;
    }
    go_on(rcl_lifecycle_get_transition_by_id(state, transition_id)->label);
  }
  result = run_callback(*previous_state);
  finish(result);
  if (result == CallbackReturn::ERROR) {
    RCLCPP_WARN(logger_, "Error occurred while doing error handling.");
    finish(run_callback(*previous_state));
  }
  return true;
}

void StateManager::finish(CallbackReturn result) {
  const std::lock_guard lock(mutex_);
  go_on(end_label(result));
}

void StateManager::go_on(const char* transition_label) {
  const rcl_lifecycle_state_t* before = state_machine_.current_state;
  if (rcl_lifecycle_trigger_transition_by_label(&state_machine_, transition_label, true) != RCL_RET_OK) {
    // The state has changed but was not published, for example because the context was shut down.
    RCLCPP_WARN(logger_, "Failed to publish transition %s of state %s: %s", transition_label, before->label,
                rcl_get_error_string().str);
    rcl_reset_error();
  }
  update_current_state();
}

StateManager::CallbackReturn StateManager::run_callback(const State& previous_state) {
  Callback callback;
  uint8_t transition_state = 0;
  {
    const std::lock_guard lock(mutex_);
    transition_state = current_state().id();
    const auto found = callbacks_.find(transition_state);
    if (found == callbacks_.end()) {
      return CallbackReturn::SUCCESS;
    }
    callback = found->second;
  }
  try {
    return callback(previous_state);
  } catch (const std::exception& error) {
    RCLCPP_ERROR(logger_, "Caught exception in callback for transition %u", unsigned{transition_state});
    RCLCPP_ERROR(logger_, "Original error: %s", error.what());
    return CallbackReturn::ERROR;
  }
}

void StateManager::update_current_state() {
  current_state_ = &constant_state(state_machine_.current_state);
}

}  // namespace rclcpp_lifecycle
