// SPDX-License-Identifier: Apache-2.0
// The topic and the services of a state machine.
#pragma once

#include <array>

#include "rcl_lifecycle/data_types.h"

namespace rcl_lifecycle {

// Of ~/change_state, ~/get_state, ~/get_available_states, ~/get_available_transitions, ~/get_transition_graph.
using ServiceTypes = std::array<const rosidl_service_type_support_t*, 5>;

// On failure nothing is left.
rcl_ret_t init(rcl_lifecycle_com_interface_t& com, rcl_node_t* node, const rosidl_message_type_support_t* event_type,
               const ServiceTypes& service_types);

// Ends all parts that are there, also after an error, and returns the first one.
rcl_ret_t fini(rcl_lifecycle_com_interface_t& com, rcl_node_t* node);

rcl_ret_t publish(const rcl_lifecycle_com_interface_t& com, const rcl_lifecycle_transition_t& transition);

}  // namespace rcl_lifecycle
