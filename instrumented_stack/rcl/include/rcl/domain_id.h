// SPDX-License-Identifier: Apache-2.0
// Reads ROS_DOMAIN_ID.
#pragma once

#include <stddef.h>

#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

// Leaves RCL_DEFAULT_DOMAIN_ID alone if the variable is not set. Returns RCL_RET_ERROR if it is not a number.
rcl_ret_t rcl_get_default_domain_id(size_t* domain_id);

#ifdef __cplusplus
}
#endif
