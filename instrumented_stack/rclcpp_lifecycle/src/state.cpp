// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_lifecycle/state.hpp"

#include <stdexcept>
#include <utility>

#include "rclcpp_lifecycle/transition.hpp"

namespace rclcpp_lifecycle {

State::State(uint8_t id, const std::string& label) : id_(id), label_(label) {
  if (label.empty()) {
    throw std::runtime_error("Lifecycle State cannot have an empty label.");
  }
}

State::State(const rcl_lifecycle_state_t* rcl_lifecycle_state) {
  if (rcl_lifecycle_state == nullptr) {
    throw std::runtime_error("rcl_lifecycle_state_handle is null");
  }
  id_ = static_cast<uint8_t>(rcl_lifecycle_state->id);
  label_ = rcl_lifecycle_state->label;
}

const State& State::checked() const {
  if (!has_state_) {
    throw std::runtime_error("Error in state! Internal state_handle is NULL.");
  }
  return *this;
}

const Transition& Transition::checked() const {
  if (!has_transition_) {
    throw std::runtime_error("Error in transition! Internal transition handle is NULL.");
  }
  return *this;
}

Transition::Transition(uint8_t id, const std::string& label) : id_(id), label_(label) {}

Transition::Transition(uint8_t id, const std::string& label, State&& start, State&& goal)
    : id_(id), label_(label), start_(std::move(start)), goal_(std::move(goal)) {}

Transition::Transition(const rcl_lifecycle_transition_t* rcl_lifecycle_transition) {
  if (rcl_lifecycle_transition == nullptr) {
    throw std::runtime_error("rcl_lifecycle_transition_handle is null");
  }
  id_ = static_cast<uint8_t>(rcl_lifecycle_transition->id);
  label_ = rcl_lifecycle_transition->label;
  start_ = State(rcl_lifecycle_transition->start);
  goal_ = State(rcl_lifecycle_transition->goal);
}

}  // namespace rclcpp_lifecycle
