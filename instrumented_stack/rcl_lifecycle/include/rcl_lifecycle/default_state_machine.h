// SPDX-License-Identifier: Apache-2.0
// The states and transitions of every managed node: https://design.ros2.org/articles/node_lifecycle.html
#pragma once

#include "rcl_lifecycle/data_types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Labels of the transitions between primary states …
extern const char* const rcl_lifecycle_configure_label;
extern const char* const rcl_lifecycle_cleanup_label;
extern const char* const rcl_lifecycle_activate_label;
extern const char* const rcl_lifecycle_deactivate_label;
extern const char* const rcl_lifecycle_shutdown_label;

// … and labels of the transitions that end a transition state, one for each result of the callback.
extern const char* const rcl_lifecycle_transition_success_label;
extern const char* const rcl_lifecycle_transition_failure_label;
extern const char* const rcl_lifecycle_transition_error_label;

rcl_lifecycle_transition_map_t rcl_lifecycle_get_default_transition_map(void);

// The state with an id of lifecycle_msgs/msg/State; null if there is none.
const rcl_lifecycle_state_t* rcl_lifecycle_get_state(const rcl_lifecycle_transition_map_t* transition_map,
                                                     unsigned int state_id);

#ifdef __cplusplus
}
#endif
