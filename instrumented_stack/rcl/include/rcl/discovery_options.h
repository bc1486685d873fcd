// SPDX-License-Identifier: Apache-2.0
// Reads ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and the older ROS_LOCALHOST_ONLY.
#pragma once

#include "rcl/types.h"
#include "rmw/discovery_options.h"

#ifdef __cplusplus
extern "C" {
#endif

// OFF, LOCALHOST, SUBNET (the default) or SYSTEM_DEFAULT. ROS_LOCALHOST_ONLY=1 means LOCALHOST and takes precedence.
// Returns RCL_RET_ERROR for another word.
rcl_ret_t rcl_get_automatic_discovery_range(rmw_discovery_options_t* discovery_options);

// Host names separated by `;`.
rcl_ret_t rcl_get_discovery_static_peers(rmw_discovery_options_t* discovery_options);

#ifdef __cplusplus
}
#endif
