// SPDX-License-Identifier: Apache-2.0
// A state machine that publishes its transitions, and has the services of a managed node. Not thread safe.
#pragma once

#include "rcl_lifecycle/data_types.h"
#include "rcl_lifecycle/default_state_machine.h"

#ifdef __cplusplus
extern "C" {
#endif

rcl_lifecycle_state_t rcl_lifecycle_get_zero_initialized_state(void);
rcl_lifecycle_transition_t rcl_lifecycle_get_zero_initialized_transition(void);

// States and transitions of a program's own. The label is copied, and freed at the end. A transition takes its states
// over: rcl_lifecycle_transition_fini() finalizes them and frees their memory, which is that of the allocator. The
// functions ending in init return RCL_RET_INVALID_ARGUMENT, or RCL_RET_ERROR without memory; those ending in fini
// RCL_RET_INVALID_ARGUMENT for an invalid allocator, and accept null.
rcl_ret_t rcl_lifecycle_state_init(rcl_lifecycle_state_t* state, unsigned int id, const char* label,
                                   const rcl_allocator_t* allocator);
rcl_ret_t rcl_lifecycle_state_fini(rcl_lifecycle_state_t* state, const rcl_allocator_t* allocator);
rcl_ret_t rcl_lifecycle_transition_init(rcl_lifecycle_transition_t* transition, unsigned int id, const char* label,
                                        rcl_lifecycle_state_t* start, rcl_lifecycle_state_t* goal,
                                        const rcl_allocator_t* allocator);
rcl_ret_t rcl_lifecycle_transition_fini(rcl_lifecycle_transition_t* transition, const rcl_allocator_t* allocator);

rcl_lifecycle_state_machine_t rcl_lifecycle_get_zero_initialized_state_machine(void);
// The default includes the com interface.
rcl_lifecycle_state_machine_options_t rcl_lifecycle_get_default_state_machine_options(void);

// Creates topic ~/transition_event and services ~/change_state, ~/get_state, ~/get_available_states,
// ~/get_available_transitions and ~/get_transition_graph, unless the options disable them, and starts in
// `unconfigured`. The node must live until the state machine is finalized. `ts_pub_notify` is for messages of C or C++,
// those of services are what their requests are taken with. Type supports may be null without com interface. Fires
// rcl_lifecycle_state_machine_init. Returns RCL_RET_INVALID_ARGUMENT, RCL_RET_ALREADY_INIT or RCL_RET_NODE_INVALID on
// errors; then nothing is left.
rcl_ret_t rcl_lifecycle_state_machine_init(rcl_lifecycle_state_machine_t* state_machine, rcl_node_t* node_handle,
                                           const rosidl_message_type_support_t* ts_pub_notify,
                                           const rosidl_service_type_support_t* ts_srv_change_state,
                                           const rosidl_service_type_support_t* ts_srv_get_state,
                                           const rosidl_service_type_support_t* ts_srv_get_available_states,
                                           const rosidl_service_type_support_t* ts_srv_get_available_transitions,
                                           const rosidl_service_type_support_t* ts_srv_get_transition_graph,
                                           const rcl_lifecycle_state_machine_options_t* options);
rcl_ret_t rcl_lifecycle_state_machine_fini(rcl_lifecycle_state_machine_t* state_machine, rcl_node_t* node_handle);
rcl_ret_t rcl_lifecycle_state_machine_is_initialized(const rcl_lifecycle_state_machine_t* state_machine);

// The transition that begins in `state`; null if there is none.
const rcl_lifecycle_transition_t* rcl_lifecycle_get_transition_by_id(const rcl_lifecycle_state_t* state,
                                                                     unsigned int id);
const rcl_lifecycle_transition_t* rcl_lifecycle_get_transition_by_label(const rcl_lifecycle_state_t* state,
                                                                        const char* label);
// The label of that transition; null if there is none.
const char* rcl_lifecycle_get_transition_label_by_id(const rcl_lifecycle_state_t* state, uint8_t id);

// Performs a transition of the current state, publishes it if enabled, and fires rcl_lifecycle_transition. Returns
// RCL_RET_ERROR and keeps the state if the current state has no such transition. If only publishing failed, returns its
// error; the state has changed.
rcl_ret_t rcl_lifecycle_trigger_transition_by_id(rcl_lifecycle_state_machine_t* state_machine, unsigned int id,
                                                 bool publish_notification);
rcl_ret_t rcl_lifecycle_trigger_transition_by_label(rcl_lifecycle_state_machine_t* state_machine, const char* label,
                                                    bool publish_notification);

// Logs all states with the labels of their transitions, as logger rcl_lifecycle with severity info.
void rcl_print_state_machine(const rcl_lifecycle_state_machine_t* state_machine);

#ifdef __cplusplus
}
#endif
