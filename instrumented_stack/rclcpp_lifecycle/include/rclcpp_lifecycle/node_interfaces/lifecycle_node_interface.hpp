// SPDX-License-Identifier: Apache-2.0
// The callbacks of a managed node. Override those that you need.
#pragma once

#include <cstdint>
#include <lifecycle_msgs/msg/transition.hpp>

#include "rclcpp_lifecycle/state.hpp"

namespace rclcpp_lifecycle::node_interfaces {

class LifecycleNodeInterface {
 public:
  enum class CallbackReturn : uint8_t {
    SUCCESS = lifecycle_msgs::msg::Transition::TRANSITION_CALLBACK_SUCCESS,
    FAILURE = lifecycle_msgs::msg::Transition::TRANSITION_CALLBACK_FAILURE,  // back to the previous state
    ERROR = lifecycle_msgs::msg::Transition::TRANSITION_CALLBACK_ERROR,      // on to on_error()
  };

  virtual ~LifecycleNodeInterface() = default;

  // Called in the transition state, by the thread that triggered the transition. `previous_state` is the state before
  // it. An exception counts as ERROR. on_shutdown() leads to `finalized` even with FAILURE; on_error() leads to
  // `unconfigured` with SUCCESS, else to `finalized`. By default all succeed except on_error(), which fails.
  virtual CallbackReturn on_configure(const State& /*previous_state*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_cleanup(const State& /*previous_state*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_shutdown(const State& /*previous_state*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_activate(const State& /*previous_state*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_deactivate(const State& /*previous_state*/) { return CallbackReturn::SUCCESS; }
  virtual CallbackReturn on_error(const State& /*previous_state*/) { return CallbackReturn::FAILURE; }
};

}  // namespace rclcpp_lifecycle::node_interfaces
