// SPDX-License-Identifier: Apache-2.0
// Performs the transitions of a node: the state machine of rcl_lifecycle with the callbacks of the node.
#pragma once

#include <rcl_lifecycle/rcl_lifecycle.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "rclcpp/logger.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp_lifecycle/node_interfaces/lifecycle_node_interface.hpp"
#include "rclcpp_lifecycle/transition.hpp"

namespace rclcpp_lifecycle {

// Thread safe, once init() has returned.
class StateManager {
 public:
  using CallbackReturn = node_interfaces::LifecycleNodeInterface::CallbackReturn;
  using Callback = std::function<CallbackReturn(const State&)>;

  StateManager(rclcpp::node_interfaces::NodeBaseInterface& node_base, rclcpp::Logger logger);
  ~StateManager();
  StateManager(const StateManager&) = delete;
  StateManager& operator=(const StateManager&) = delete;

  // Starts in `unconfigured`, with or without the topic and the services of the state machine. Throws
  // rclcpp::exceptions::RCLError.
  void init(bool enable_communication_interface);

  rcl_lifecycle_com_interface_t& com_interface() { return state_machine_.com_interface; }

  // The callback of a transition state, TRANSITION_STATE_… of lifecycle_msgs/msg/State. Replaces an earlier one.
  void set_callback(uint8_t transition_state, Callback callback);
  // From now on transitions succeed without a callback.
  void forget_callbacks();

  // The returned state lives as long as the program.
  const State& current_state() const { return *current_state_; }
  std::vector<State> states() const;
  std::vector<Transition> transitions() const;
  std::vector<Transition> transitions_of_current_state() const;

  // Performs a whole transition with its callback, and error processing if needed. If the current state has no such
  // transition, logs the reason and returns false.
  bool change_state(uint8_t transition_id, CallbackReturn& result);
  // Takes a label. Returns false, without logging, if the current state has no such transition.
  bool change_state(const std::string& transition_label, CallbackReturn& result);

 private:
  // Triggers a transition that the current state has. The lock must be held.
  void go_on(const char* transition_label);
  // Ends a transition state.
  void finish(CallbackReturn result);
  CallbackReturn run_callback(const State& previous_state);
  void update_current_state();  // the lock must be held

  const std::shared_ptr<rcl_node_t> node_handle_;
  const rclcpp::Logger logger_;
  mutable std::mutex mutex_;  // never held while a callback runs
  rcl_lifecycle_state_machine_t state_machine_ = rcl_lifecycle_get_zero_initialized_state_machine();
  std::atomic<const State*> current_state_{nullptr};
  std::map<uint8_t, Callback> callbacks_;  // key: transition state
};

}  // namespace rclcpp_lifecycle
