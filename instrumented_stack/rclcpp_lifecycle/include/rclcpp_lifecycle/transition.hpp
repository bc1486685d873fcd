// SPDX-License-Identifier: Apache-2.0
// A transition of a managed node: an id of lifecycle_msgs/msg/Transition, its label, and the states that it joins.
#pragma once

#include <rcl_lifecycle/data_types.h>

#include <cstdint>
#include <string>

#include "rclcpp_lifecycle/state.hpp"

namespace rclcpp_lifecycle {

// A value type: any thread may copy and read its own copy.
class Transition {
 public:
  explicit Transition(uint8_t id, const std::string& label = "");
  Transition(uint8_t id, const std::string& label, State&& start, State&& goal);
  // Throws std::runtime_error for null.
  explicit Transition(const rcl_lifecycle_transition_t* rcl_lifecycle_transition);
  virtual ~Transition() = default;
  Transition(const Transition&) = default;
  Transition& operator=(const Transition&) = default;

  // Throw std::runtime_error after reset().
  uint8_t id() const { return checked().id_; }
  std::string label() const { return checked().label_; }
  State start_state() const { return checked().start_; }
  State goal_state() const { return checked().goal_; }

 protected:
  // Takes the transition away.
  void reset() noexcept { has_transition_ = false; }

 private:
  const Transition& checked() const;

  bool has_transition_ = true;
  uint8_t id_;
  std::string label_;
  State start_;
  State goal_;
};

}  // namespace rclcpp_lifecycle
