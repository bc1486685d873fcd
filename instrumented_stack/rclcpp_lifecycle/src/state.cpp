// SPDX-License-Identifier: Apache-2.0
#include "rclcpp_lifecycle/state.hpp"

#include <stdexcept>

namespace rclcpp_lifecycle {

State::State(uint8_t id, const std::string& label) : id_(id), label_(label) {
  if (label.empty()) {
    throw std::runtime_error("Lifecycle State cannot have an empty label.");
  }
}

State::State(const rcl_lifecycle_state_t* rcl_lifecycle_state) {
  if (rcl_lifecycle_state == nullptr) {
    throw std::invalid_argument("rcl_lifecycle_state_handle is null");
  }
  id_ = static_cast<uint8_t>(rcl_lifecycle_state->id);
  label_ = rcl_lifecycle_state->label;
}

}  // namespace rclcpp_lifecycle
