// SPDX-License-Identifier: Apache-2.0
// A state of a managed node: an id of lifecycle_msgs/msg/State and its label.
#pragma once

#include <rcl_lifecycle/data_types.h>

#include <cstdint>
#include <string>

namespace rclcpp_lifecycle {

// A value type: any thread may copy and read its own copy.
class State {
 public:
  State() = default;  // unknown
  // Throws std::runtime_error if the label is empty.
  State(uint8_t id, const std::string& label);
  // Throws std::runtime_error for null.
  explicit State(const rcl_lifecycle_state_t* rcl_lifecycle_state);
  virtual ~State() = default;
  State(const State&) = default;
  State& operator=(const State&) = default;

  // Throw std::runtime_error after reset().
  uint8_t id() const { return checked().id_; }
  std::string label() const { return checked().label_; }

 protected:
  // Takes the state away.
  void reset() noexcept { has_state_ = false; }

 private:
  const State& checked() const;

  bool has_state_ = true;
  uint8_t id_ = 0;
  std::string label_ = "unknown";
};

}  // namespace rclcpp_lifecycle
