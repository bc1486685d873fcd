// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstring>
#include <lifecycle_msgs/msg/state.hpp>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>

#include "rcl/error_handling.h"
#include "rcl_lifecycle/rcl_lifecycle.h"
#include "tracetools/tracetools.h"

namespace {

using lifecycle_msgs::msg::TransitionEvent;

template <typename MatchesT>
const rcl_lifecycle_transition_t* find_transition(const rcl_lifecycle_state_t* state, MatchesT matches) {
  const rcl_lifecycle_transition_t* end = state->valid_transitions + state->valid_transition_size;
  const rcl_lifecycle_transition_t* found = std::find_if(state->valid_transitions, end, matches);
  return found == end ? nullptr : found;
}

rcl_ret_t publish(const rcl_publisher_t& publisher, const rcl_lifecycle_transition_t& transition) {
  TransitionEvent event;
  event.timestamp = static_cast<uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count());
  event.transition.id = static_cast<uint8_t>(transition.id);
  event.transition.label = transition.label;
  event.start_state.id = static_cast<uint8_t>(transition.start->id);
  event.start_state.label = transition.start->label;
  event.goal_state.id = static_cast<uint8_t>(transition.goal->id);
  event.goal_state.label = transition.goal->label;
  return rcl_publish(&publisher, &event, nullptr);
}

rcl_ret_t trigger(rcl_lifecycle_state_machine_t* state_machine, const rcl_lifecycle_transition_t* transition,
                  bool publish_notification) {
  if (transition == nullptr) {
    RCL_SET_ERROR_MSG("Transition is not registered.");
    return RCL_RET_ERROR;
  }
  state_machine->current_state = transition->goal;
  rcl_ret_t ret = RCL_RET_OK;
  if (publish_notification && state_machine->options.enable_com_interface) {
    ret = publish(state_machine->pub_transition_event, *transition);
  }
  // ROS 2 does not fire it if publishing failed. But the state has changed, and a trace must show that.
  TRACETOOLS_TRACEPOINT(rcl_lifecycle_transition, static_cast<const void*>(state_machine), transition->start->label,
                        transition->goal->label);
  return ret;
}

}  // namespace

rcl_lifecycle_state_machine_t rcl_lifecycle_get_zero_initialized_state_machine(void) {
  return {};
}

rcl_lifecycle_state_machine_options_t rcl_lifecycle_get_default_state_machine_options(void) {
  return {true};
}

rcl_ret_t rcl_lifecycle_state_machine_init(rcl_lifecycle_state_machine_t* state_machine, rcl_node_t* node_handle,
                                           const rcl_lifecycle_state_machine_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(state_machine, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_handle, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  if (state_machine->current_state != nullptr) {
    RCL_SET_ERROR_MSG("the state machine is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  if (options->enable_com_interface) {
    const rcl_publisher_options_t publisher_options = rcl_publisher_get_default_options();
    const rcl_ret_t ret = rcl_publisher_init(&state_machine->pub_transition_event, node_handle,
                                             rosidl_typesupport_cpp::get_message_type_support_handle<TransitionEvent>(),
                                             "~/transition_event", &publisher_options);
    if (ret != RCL_RET_OK) {
      return ret;
    }
  }
  state_machine->options = *options;
  state_machine->transition_map = rcl_lifecycle_get_default_transition_map();
  state_machine->current_state =
      rcl_lifecycle_get_state(&state_machine->transition_map, lifecycle_msgs::msg::State::PRIMARY_STATE_UNCONFIGURED);
  TRACETOOLS_TRACEPOINT(rcl_lifecycle_state_machine_init, static_cast<const void*>(node_handle),
                        static_cast<const void*>(state_machine));
  return RCL_RET_OK;
}

rcl_ret_t rcl_lifecycle_state_machine_fini(rcl_lifecycle_state_machine_t* state_machine, rcl_node_t* node_handle) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(state_machine, RCL_RET_INVALID_ARGUMENT);
  if (state_machine->current_state != nullptr) {
    TRACETOOLS_EXT_TRACEPOINT(rcl_lifecycle_state_machine_fini, static_cast<const void*>(state_machine));
  }
  rcl_ret_t ret = RCL_RET_OK;
  if (state_machine->pub_transition_event.impl != nullptr) {
    ret = rcl_publisher_fini(&state_machine->pub_transition_event, node_handle);
  }
  *state_machine = rcl_lifecycle_get_zero_initialized_state_machine();
  return ret;
}

rcl_ret_t rcl_lifecycle_state_machine_is_initialized(const rcl_lifecycle_state_machine_t* state_machine) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(state_machine, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(state_machine->current_state, "State machine not initialized",
                                  return RCL_RET_INVALID_ARGUMENT);
  return RCL_RET_OK;
}

const rcl_lifecycle_transition_t* rcl_lifecycle_get_transition_by_id(const rcl_lifecycle_state_t* state,
                                                                     unsigned int id) {
  return find_transition(state, [&](const auto& transition) { return transition.id == id; });
}

const rcl_lifecycle_transition_t* rcl_lifecycle_get_transition_by_label(const rcl_lifecycle_state_t* state,
                                                                        const char* label) {
  return find_transition(state, [&](const auto& transition) { return std::strcmp(transition.label, label) == 0; });
}

const char* rcl_lifecycle_get_transition_label_by_id(const rcl_lifecycle_state_t* state, uint8_t id) {
  const rcl_lifecycle_transition_t* const transition = rcl_lifecycle_get_transition_by_id(state, id);
  return transition == nullptr ? nullptr : transition->label;
}

rcl_ret_t rcl_lifecycle_trigger_transition_by_id(rcl_lifecycle_state_machine_t* state_machine, unsigned int id,
                                                 bool publish_notification) {
  const rcl_ret_t ret = rcl_lifecycle_state_machine_is_initialized(state_machine);
  return ret != RCL_RET_OK
             ? ret
             : trigger(state_machine, rcl_lifecycle_get_transition_by_id(state_machine->current_state, id),
                       publish_notification);
}

rcl_ret_t rcl_lifecycle_trigger_transition_by_label(rcl_lifecycle_state_machine_t* state_machine, const char* label,
                                                    bool publish_notification) {
  const rcl_ret_t ret = rcl_lifecycle_state_machine_is_initialized(state_machine);
  return ret != RCL_RET_OK
             ? ret
             : trigger(state_machine, rcl_lifecycle_get_transition_by_label(state_machine->current_state, label),
                       publish_notification);
}
