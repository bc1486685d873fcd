// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <lifecycle_msgs/msg/state.hpp>
#include <string>

#include "com_interface.hpp"
#include "rcl/error_handling.h"
#include "rcl_lifecycle/rcl_lifecycle.h"
#include "rcutils/logging_macros.h"
#include "tracetools/tracetools.h"

namespace {

template <typename MatchesT>
const rcl_lifecycle_transition_t* find_transition(const rcl_lifecycle_state_t* state, MatchesT matches) {
  const rcl_lifecycle_transition_t* end = state->valid_transitions + state->valid_transition_size;
  const rcl_lifecycle_transition_t* found = std::find_if(state->valid_transitions, end, matches);
  return found == end ? nullptr : found;
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
    ret = rcl_lifecycle::publish(state_machine->com_interface, *transition);
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
  return {true, true, rcl_get_default_allocator()};
}

rcl_ret_t rcl_lifecycle_state_machine_init(rcl_lifecycle_state_machine_t* state_machine, rcl_node_t* node_handle,
                                           const rosidl_message_type_support_t* ts_pub_notify,
                                           const rosidl_service_type_support_t* ts_srv_change_state,
                                           const rosidl_service_type_support_t* ts_srv_get_state,
                                           const rosidl_service_type_support_t* ts_srv_get_available_states,
                                           const rosidl_service_type_support_t* ts_srv_get_available_transitions,
                                           const rosidl_service_type_support_t* ts_srv_get_transition_graph,
                                           const rcl_lifecycle_state_machine_options_t* options) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(state_machine, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_handle, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(options, RCL_RET_INVALID_ARGUMENT);
  if (state_machine->current_state != nullptr) {
    RCL_SET_ERROR_MSG("the state machine is initialized already");
    return RCL_RET_ALREADY_INIT;
  }
  if (options->enable_com_interface) {
    const rcl_ret_t ret = rcl_lifecycle::init(state_machine->com_interface, node_handle, ts_pub_notify,
                                              {ts_srv_change_state, ts_srv_get_state, ts_srv_get_available_states,
                                               ts_srv_get_available_transitions, ts_srv_get_transition_graph});
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
  const rcl_ret_t ret = rcl_lifecycle::fini(state_machine->com_interface, node_handle);
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

void rcl_print_state_machine(const rcl_lifecycle_state_machine_t* state_machine) {
  const rcl_lifecycle_transition_map_t& map = state_machine->transition_map;
  for (unsigned int i = 0; i < map.states_size; ++i) {
    const rcl_lifecycle_state_t& state = map.states[i];
    std::string transitions;
    for (unsigned int j = 0; j < state.valid_transition_size; ++j) {
      transitions += (j == 0 ? ": " : ", ") + std::string(state.valid_transitions[j].label);
    }
    RCUTILS_LOG_INFO_NAMED("rcl_lifecycle", "state %s(%u), %u transitions%s", state.label, state.id,
                           state.valid_transition_size, transitions.c_str());
  }
}
