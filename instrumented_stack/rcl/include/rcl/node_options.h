// SPDX-License-Identifier: Apache-2.0
// The options for creating a node besides its name.
#pragma once

#include <stdbool.h>

#include "rcl/allocator.h"
#include "rcl/arguments.h"
#include "rcl/types.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rcl_node_options_s {
  rcl_allocator_t allocator;
  bool use_global_arguments;  // also apply the arguments of the context, after the node's own
  rcl_arguments_t arguments;
  bool enable_rosout;
  rmw_qos_profile_t rosout_qos;
} rcl_node_options_t;

rcl_node_options_t rcl_node_get_default_options(void);
rcl_ret_t rcl_node_options_copy(const rcl_node_options_t* options, rcl_node_options_t* options_out);
rcl_ret_t rcl_node_options_fini(rcl_node_options_t* options);

#ifdef __cplusplus
}
#endif
