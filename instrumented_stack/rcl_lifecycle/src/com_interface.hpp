// The topic and the services of a state machine.
#pragma once

#include "rcl_lifecycle/data_types.h"

struct ServiceTypeSupports {
  const rosidl_service_type_support_t* change_state;
  const rosidl_service_type_support_t* get_state;
  const rosidl_service_type_support_t* get_available_states;
  const rosidl_service_type_support_t* get_available_transitions;
  const rosidl_service_type_support_t* get_transition_graph;
};

// All of them or none.
rcl_ret_t com_interface_init(rcl_lifecycle_com_interface_t* com_interface, rcl_node_t* node_handle,
                             const ServiceTypeSupports& type_supports);
// Also for one that was never initialised. The first error, after trying all.
rcl_ret_t com_interface_fini(rcl_lifecycle_com_interface_t* com_interface, rcl_node_t* node_handle);

rcl_ret_t publish_transition_event(const rcl_lifecycle_com_interface_t* com_interface,
                                   const rcl_lifecycle_transition_t& transition);
