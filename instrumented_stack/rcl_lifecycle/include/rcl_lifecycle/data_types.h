// SPDX-License-Identifier: Apache-2.0
// The parts of a state machine. Ids are those of lifecycle_msgs.
#pragma once

#include <stdbool.h>

#include "rcl/node.h"
#include "rcl/publisher.h"
#include "rcl/service.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_lifecycle_transition_s rcl_lifecycle_transition_t;

// A state and the transitions that begin in it.
typedef struct rcl_lifecycle_state_s {
  const char* label;
  unsigned int id;
  const rcl_lifecycle_transition_t* valid_transitions;
  unsigned int valid_transition_size;
} rcl_lifecycle_state_t;

// Labels are unique among the transitions of one state, but not among all transitions.
struct rcl_lifecycle_transition_s {
  const char* label;
  unsigned int id;
  const rcl_lifecycle_state_t* start;
  const rcl_lifecycle_state_t* goal;
};

// All states and transitions. They are constants, so the map owns nothing.
typedef struct rcl_lifecycle_transition_map_s {
  const rcl_lifecycle_state_t* states;
  unsigned int states_size;
  const rcl_lifecycle_transition_t* transitions;
  unsigned int transitions_size;
} rcl_lifecycle_transition_map_t;

typedef struct rcl_lifecycle_state_machine_options_s {
  bool initialize_default_states;  // every state machine has the default states
  bool enable_com_interface;       // whether there is a com interface
  rcl_allocator_t allocator;
} rcl_lifecycle_state_machine_options_t;

// How other nodes see and control the states. Who made the state machine answers the requests of the services.
typedef struct rcl_lifecycle_com_interface_s {
  rcl_node_t* node_handle;
  rcl_publisher_t pub_transition_event;
  rcl_service_t srv_change_state;
  rcl_service_t srv_get_state;
  rcl_service_t srv_get_available_states;
  rcl_service_t srv_get_available_transitions;
  rcl_service_t srv_get_transition_graph;
  bool has_messages_of_c;  // on its topic
} rcl_lifecycle_com_interface_t;

typedef struct rcl_lifecycle_state_machine_s {
  const rcl_lifecycle_state_t* current_state;  // null if not initialized
  rcl_lifecycle_transition_map_t transition_map;
  rcl_lifecycle_com_interface_t com_interface;
  rcl_lifecycle_state_machine_options_t options;
} rcl_lifecycle_state_machine_t;

#ifdef __cplusplus
}
#endif
